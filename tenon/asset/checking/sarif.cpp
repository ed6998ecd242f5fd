// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Results refer to rules by index, so the rules that are broken are collected first, each once and
// sorted by name. The fingerprint of a result hashes rule, file, prim and property but neither line
// nor message: it stays the same while a file grows above the finding. Columns of a diagnostic are
// bytes and have to be turned into characters, which is done for all findings together. Findings
// that a baseline knows stay in the log, marked as suppressed.
#include "tenon/asset/checking/sarif.h"

#include <algorithm>
#include <cctype>
#include <map>

#include "tenon/base/sha256.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/check/rule.h"
#include "tenon/formats/character_columns.h"

namespace tenon {
namespace {

using answers::Json;

const char* sarif_level(Severity severity) {
  switch (severity) {
    case Severity::Error:
      return "error";
    case Severity::Warning:
      return "warning";
    case Severity::Info:
      break;
  }
  return "note";
}

/// The path of a URI: what is not a plain letter of one is written as its bytes.
std::string sarif_uri(const std::string& path) {
  std::string uri;
  for (const char c : path_from_here(path)) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain =
        std::isalnum(byte) != 0 || std::string_view("-._~/").find(c) != std::string::npos;
    if (plain) {
      uri += c;
    } else {
      constexpr char kDigits[] = "0123456789ABCDEF";
      uri += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
    }
  }
  return uri;
}

Json sarif_rule(const std::string& id, Severity severity) {
  const check::Rule* rule = check::find_rule(id);
  const std::string_view page = check::page_of(id);
  Json json = Json::object();
  json["id"] = id;
  const std::string title = check::title_of(page);
  json["shortDescription"] = {{"text", title.empty() ? id : title}};
  if (!page.empty()) {
    json["help"] = {{"text", page}, {"markdown", page}};
  }
  json["defaultConfiguration"] = {
      {"level", sarif_level(rule == nullptr ? severity : rule->severity)}};
  if (rule != nullptr && !rule->numbers.empty()) {
    json["properties"] = {{"numbers", rule->numbers}};
  }
  return json;
}

/// Where a finding stands, from its first character to the one behind its last.
Json sarif_region(const Diagnostic& d, formats::CharacterColumns columns) {
  Json region = {{"startLine", d.line}};
  if (columns.column > 0) {
    region["startColumn"] = columns.column;
  }
  if (columns.column > 0 && columns.end_column > 0) {
    region["endLine"] = d.end_line;
    region["endColumn"] = columns.end_column;
  }
  return region;
}

Json sarif_location(const Diagnostic& d, formats::CharacterColumns columns) {
  Json location = Json::object();
  if (!d.file.empty()) {
    Json physical = {{"artifactLocation", {{"uri", sarif_uri(d.file)}}}};
    if (d.line > 0) {
      physical["region"] = sarif_region(d, columns);
    }
    location["physicalLocation"] = std::move(physical);
  }
  if (!d.prim.empty()) {
    const std::string name = d.prim + (d.property.empty() ? "" : "." + d.property);
    location["logicalLocations"] = Json::array(
        {{{"fullyQualifiedName", name}, {"kind", d.property.empty() ? "object" : "member"}}});
  }
  return location;
}

/// What else a finding is about; its message says as what.
Json sarif_related(const RelatedPrim& related) {
  Diagnostic place;
  place.file = related.file;
  place.line = related.line;
  place.prim = related.path.substr(0, related.path.find('.'));
  place.property = related.path.substr(std::min(place.prim.size() + 1, related.path.size()));
  Json location = sarif_location(place, {});
  location["message"] = {{"text", role_name(related.role)}};
  return location;
}

Json sarif_result(const ReportedFinding& reported, formats::CharacterColumns columns,
                  std::size_t rule_index) {
  const Diagnostic& d = reported.finding.diagnostic;
  Json result = Json::object();
  result["ruleId"] = d.rule;
  result["ruleIndex"] = rule_index;
  result["level"] = sarif_level(d.severity);
  result["message"] = {{"text", d.fix.empty() ? d.message : d.message + "; " + d.fix}};
  const Json location = sarif_location(d, columns);
  result["locations"] = location.empty() ? Json::array() : Json::array({location});
  for (const RelatedPrim& related : d.related) {
    result["relatedLocations"].push_back(sarif_related(related));
  }
  Sha256 digest;
  digest.update(fingerprint_of(reported.finding, "."));
  result["partialFingerprints"] = {{"tenon/1", digest.hex_digest()}};
  if (reported.suppressed) {
    result["suppressions"] = Json::array({{{"kind", "external"}, {"status", "accepted"}}});
  }
  if (!reported.finding.variants.empty()) {
    result["properties"] = {{"physicsVariants", reported.finding.variants}};
  }
  return result;
}

}  // namespace

Json sarif_log(const std::vector<ReportedFinding>& findings, const std::string& version,
               const bytes::Files& files) {
  std::map<std::string, Severity> broken;
  for (const ReportedFinding& reported : findings) {
    broken.emplace(reported.finding.diagnostic.rule, reported.finding.diagnostic.severity);
  }
  std::map<std::string, std::size_t> index;
  Json rules = Json::array();
  for (const auto& [id, severity] : broken) {
    index[id] = rules.size();
    rules.push_back(sarif_rule(id, severity));
  }
  Json results = Json::array();
  std::vector<const Diagnostic*> diagnostics;
  for (const ReportedFinding& reported : findings) {
    diagnostics.push_back(&reported.finding.diagnostic);
  }
  const std::vector<formats::CharacterColumns> columns =
      formats::character_columns(diagnostics, files);
  for (std::size_t i = 0; i < findings.size(); ++i) {
    results.push_back(sarif_result(findings[i], columns[i], index[diagnostics[i]->rule]));
  }
  Json driver = {{"name", "tenon"}, {"version", version}, {"rules", std::move(rules)}};
  Json run = Json::object();
  run["tool"] = {{"driver", std::move(driver)}};
  run["columnKind"] = "unicodeCodePoints";  // elsewhere columns are bytes
  run["results"] = std::move(results);
  Json log = Json::object();
  log["$schema"] = "https://json.schemastore.org/sarif-2.1.0.json";
  log["version"] = "2.1.0";
  log["runs"] = Json::array({std::move(run)});
  return log;
}

}  // namespace tenon
