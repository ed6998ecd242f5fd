// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/checking/baseline.h"

#include <filesystem>

#include "tenon/answers/json.h"
#include "tenon/base/limits/reading_limits.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/check/rule.h"

namespace tenon {
namespace {

using answers::Json;

constexpr const char* kBaselineSchema = "tenon.baseline/1";

std::string baseline_folder(const std::string& path) {
  return std::filesystem::path(path).parent_path().string();
}

std::string baseline_text(const Json& item, const char* key) {
  return item.is_object() && item.contains(key) && item[key].is_string()
             ? item[key].get<std::string>()
             : std::string();
}

}  // namespace

Result<Baseline> Baseline::read(const std::string& path, const bytes::Files& files) {
  bytes::FileRules rules;
  rules.max_bytes = limits::kJsonFileBytes;
  TENON_TRY(const auto bytes, files->open(path, rules));
  const auto bad = [&](const std::string& why) {
    return Error(ErrorCode::Parse, "the file is not a baseline that tenon check wrote: " + why)
        .in_file(path)
        .with_fix("write one with --write-baseline");
  };
  TENON_TRY(const Json json, answers::parsed_file(bytes->text(), bad));
  const bool usable = json.is_object() && baseline_text(json, "schema") == kBaselineSchema &&
                      json.contains("findings") && json["findings"].is_array();
  if (!usable) {
    return bad(std::string("it has no \"schema\" \"") + kBaselineSchema +
               "\" with a list \"findings\"");
  }
  Baseline baseline;
  baseline.folder_ = baseline_folder(path);
  for (const Json& item : json["findings"]) {
    if (baseline_text(item, "rule").empty()) {
      return bad("a finding of it has no \"rule\"");
    }
    const std::string key = std::string(check::current_id(baseline_text(item, "rule"))) + "\n" +
                            baseline_text(item, "file") + "\n" + baseline_text(item, "prim") +
                            "\n" + baseline_text(item, "property");
    const bool counted =
        item.is_object() && item.contains("count") && item["count"].is_number_unsigned();
    baseline.count_[key] += counted ? item["count"].get<std::size_t>() : 1;
  }
  return baseline;
}

std::string Baseline::text_of(const std::vector<ReportedFinding>& findings,
                              const std::string& path) {
  struct Known {
    const check::Finding* finding = nullptr;
    std::size_t count = 0;
  };
  const std::string folder = baseline_folder(path);
  std::map<std::string, Known> known;
  for (const ReportedFinding& reported : findings) {
    Known& entry = known[fingerprint_of(reported.finding, folder)];
    entry.finding = &reported.finding;
    ++entry.count;
  }
  Json items = Json::array();
  for (const auto& [key, entry] : known) {
    const Diagnostic& d = entry.finding->diagnostic;
    const std::size_t first = key.find('\n') + 1;
    Json item = {{"rule", d.rule},
                 {"file", key.substr(first, key.find('\n', first) - first)},
                 {"prim", d.prim},
                 {"property", d.property}};
    if (entry.count > 1) {
      item["count"] = entry.count;
    }
    items.push_back(std::move(item));
  }
  Json json = {{"tool", "tenon"}, {"schema", kBaselineSchema}, {"findings", std::move(items)}};
  return answers::printed(json, false, 1);
}

void Baseline::suppress(std::vector<ReportedFinding>& findings) const {
  std::map<std::string, std::size_t> left = count_;
  for (ReportedFinding& reported : findings) {
    const auto found = left.find(fingerprint_of(reported.finding, folder_));
    if (found != left.end() && found->second > 0) {
      --found->second;
      reported.suppressed = true;
    }
  }
}

}  // namespace tenon
