// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/checking/checked_json.h"

#include "tenon/answers/diagnostic_json.h"
#include "tenon/asset/answers/edited_json.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/check/fixes.h"
#include "tenon/check/rep0158/rep0158.h"
#include "tenon/check/rule.h"
#include "tenon/check/simready/requirement.h"

namespace tenon {
namespace {

using answers::Json;

/// The engines that a rule of portability is about; null for other rules.
Json engines_json(const check::Rule& rule) {
  Json names = Json::array();
  for (const std::string& engine : check::known_engines()) {
    if (rule.is_about(engine)) {
      names.push_back(engine);
    }
  }
  return names.empty() ? Json(nullptr) : names;
}

/// The requirement of a profile with codes whose findings have this rule; null for other rules.
const check::simready::Requirement* requirement_of(std::string_view rule) {
  const auto* found = check::simready::find_requirement(check::simready::requirements(), rule);
  return found != nullptr ? found
                          : check::simready::find_requirement(check::rep0158::requirements(), rule);
}

Json finding_json(const ReportedFinding& reported) {
  const check::Finding& finding = reported.finding;
  Json item = answers::diagnostic_json(finding.diagnostic);
  item["variants"] = finding.variants.empty() ? Json(nullptr) : Json(finding.variants);
  const bool numbered = finding.rule != nullptr && !finding.rule->numbers.empty();
  item["numbers"] = numbered ? Json(finding.rule->numbers) : Json(nullptr);
  item["engines"] = finding.rule == nullptr ? Json(nullptr) : engines_json(*finding.rule);
  item["autofix"] = finding.fix ? Json(finding.fix->what) : Json(nullptr);
  item["suggestedFix"] = finding.suggestion ? Json(finding.suggestion->what) : Json(nullptr);
  item["suppressed"] = reported.suppressed;
  const auto* requirement = requirement_of(finding.diagnostic.rule);
  item["code"] = requirement == nullptr ? Json(nullptr) : Json(requirement->full_code());
  return item;
}

/// What became of each requirement of a profile with codes; null where it has none.
Json codes_json(const std::vector<check::simready::CodeVerdict>& codes) {
  Json list = Json::array();
  for (const check::simready::CodeVerdict& one : codes) {
    list.push_back({{"code", one.requirement->full_code()},
                    {"verdict", check::simready::verdict_name(one.verdict)},
                    {"reason", one.reason.empty() ? Json(nullptr) : Json(one.reason)}});
  }
  return list.empty() ? Json(nullptr) : list;
}

/// The files that are corrected, with what changes in those that are text.
Json corrected_json(const std::vector<EditedFile>& corrected) {
  Json files = Json::array();
  for (const EditedFile& file : corrected) {
    const std::string name = shown_path(file.path);
    files.push_back(
        {{"file", name}, {"diff", text_difference_json(name, file.before, file.after, file.text)}});
  }
  return files;
}

Json skipped_json(const std::vector<SkippedFindings>& skipped) {
  Json list = Json::array();
  for (const SkippedFindings& one : skipped) {
    list.push_back({{"rule", one.rule},
                    {"reason", one.reason},
                    {"count", one.count},
                    {"settings", shown_path(one.settings)}});
  }
  return list;
}

}  // namespace

Json checked_json(const CheckedAssets& checked, std::string_view corrected_key) {
  Json body = Json::object();
  body["diagnostics"] = Json::array();
  for (const ReportedFinding& reported : checked.findings) {
    body["diagnostics"].push_back(finding_json(reported));
  }
  const FindingCounts counts = count_findings(checked.findings);
  body["summary"] = {{"errors", counts.errors},       {"warnings", counts.warnings},
                     {"infos", counts.infos},         {"fixable", counts.fixable},
                     {"suggested", counts.suggested}, {"suppressed", counts.suppressed}};
  body["assets"] = Json::array();
  for (const AssetChecked& asset : checked.assets) {
    body["assets"].push_back(
        {{"asset", shown_path(asset.path)},
         {"opened", asset.opened},
         {"variants", asset.variants},
         {"settings", asset.settings.empty() ? Json(nullptr) : Json(shown_path(asset.settings))},
         {"codes", codes_json(asset.codes)}});
  }
  body["skipped"] = skipped_json(checked.skipped);
  if (!corrected_key.empty()) {
    body[std::string(corrected_key)] = corrected_json(checked.corrected);
  }
  return body;
}

Json rules_json() {
  Json list = Json::array();
  for (const check::Rule& rule : check::rules()) {
    list.push_back({{"rule", rule.id},
                    {"severity", severity_name(rule.severity)},
                    {"numbers", rule.numbers},
                    {"autofix", rule.fix != nullptr},
                    {"suggestedFix", check::suggestion_for(rule.id) != nullptr},
                    {"engines", engines_json(rule)},
                    {"title", check::title_of(check::page_of(rule.id))}});
  }
  return {{"rules", std::move(list)}};
}

}  // namespace tenon
