// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// All assets add to one list of findings. They share layers, so a finding counts once by its place,
// rule and message. With --fix an asset is checked, its fixes are written in place, and it is
// checked again, so that the report tells what is left; a dry run reports the first check. The
// baseline is held against the whole list at the end, because it says how many equal findings are
// known. Reports are claimed before the work and written together after it.
#include <algorithm>
#include <cstdio>
#include <iterator>
#include <set>
#include <tuple>

#include <unistd.h>

#include "cli/baseline.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/reading_options.h"
#include "cli/report.h"
#include "cli/text/sarif.h"
#include "cli/text/unified_diff.h"
#include "cli/verb.h"
#include "tenon/asset/check_asset.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/check/rule.h"

namespace tenon::cli {
namespace {

struct CheckArguments {
  std::vector<std::string> paths;
  AssetArguments asset;
  check::Selection rules;
  std::vector<std::string> readings;  ///< --reading NAME=VALUE
  std::string profile;
  bool fix = false;
  bool dry_run = false;
  bool strict = false;
  bool list_rules = false;
  std::string explain;
  std::string sarif;
  std::string baseline;
  std::string write_baseline;
};

struct Counts {
  std::size_t errors = 0;
  std::size_t warnings = 0;
  std::size_t infos = 0;
  std::size_t fixable = 0;
  std::size_t suppressed = 0;
};

/// What came of all assets together.
struct Outcome {
  std::vector<ReportedFinding> findings;
  std::vector<EditedFile> corrected;
  Json assets = Json::array();
  bool failed = false;
};

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

class Run {
 public:
  Run(const Globals& globals, const CheckArguments& options, Report& report)
      : globals_(globals), options_(options), report_(report) {}

  Result<Outcome> all_assets() {
    std::set<std::string> seen;
    std::vector<std::string> all;
    for (const std::string& path : options_.paths) {
      TENON_TRY(const std::vector<std::string> roots,
                root_assets(path, options_.asset.open_options()));
      std::copy_if(roots.begin(), roots.end(), std::back_inserter(all),
                   [&](const std::string& root) { return seen.insert(root).second; });
    }
    Progress progress(globals_, "checking");
    for (std::size_t i = 0; i < all.size(); ++i) {
      progress.at(static_cast<double>(i), static_cast<double>(all.size()), "assets");
      TENON_CHECK(one_asset(all[i]));
    }
    if (!options_.baseline.empty()) {
      TENON_TRY(const Baseline baseline, Baseline::read(options_.baseline));
      baseline.suppress(outcome_.findings);
    }
    return std::move(outcome_);
  }

 private:
  Result<void> one_asset(const std::string& path) {
    CheckOptions check;
    check.open = options_.asset.open_options();
    check.rules = options_.rules;
    check.profile = options_.profile;
    TENON_TRY(check.readings, chosen_readings(options_.readings));
    Result<CheckedAsset> checked = CheckedAsset();
    bool changed = false;
    if (options_.fix) {
      TENON_TRY(changed, correct(path, check, checked));
    }
    if (!options_.fix || (changed && !options_.dry_run)) {
      checked = check_asset(path, check);
    }
    Json asset = Json::object();
    asset["asset"] = shown_path(path);
    asset["opened"] = checked.has_value();
    asset["variants"] = checked ? checked->variants : std::vector<std::string>();
    outcome_.assets.push_back(std::move(asset));
    if (!checked) {
      outcome_.failed = true;
      add(checked.error().diagnostic());
      for (const Diagnostic& further : checked.error().further()) {
        add(further);
      }
      return {};
    }
    for (check::Finding& finding : checked->findings) {
      add(std::move(finding));
    }
    return {};
  }

  void add(const Diagnostic& fault) {
    check::Finding finding;
    finding.diagnostic = fault;
    finding.rule = check::find_rule(fault.rule);
    add(std::move(finding));
  }

  /// Assets share layers: what is wrong in one is said once.
  void add(check::Finding finding) {
    const Diagnostic& d = finding.diagnostic;
    if (known_.emplace(d.file, d.line, d.column, d.prim, d.property, d.rule, d.message).second) {
      outcome_.findings.push_back({std::move(finding), false});
    }
  }

  /// None for an asset that cannot be checked.
  Result<std::vector<EditedFile>> write_corrected(const std::string& path,
                                                  const CheckOptions& check,
                                                  Result<CheckedAsset>& checked) const {
    checked = check_asset(path, check);
    if (!checked) {
      return std::vector<EditedFile>();
    }
    TENON_TRY(std::vector<EditedFile> files, corrected_files(checked->findings));
    Outputs outputs = Outputs::in_place();
    for (const EditedFile& file : files) {
      outputs.put(file.path, file.after);
    }
    if (!options_.dry_run) {
      TENON_CHECK(outputs.commit());
    }
    return files;
  }

  /// Whether there was something to correct.
  Result<bool> correct(const std::string& path, const CheckOptions& check,
                       Result<CheckedAsset>& checked) {
    TENON_TRY(std::vector<EditedFile> files,
              edit_files(report_, [&] { return write_corrected(path, check, checked); }));
    for (EditedFile& file : files) {
      const bool known =
          std::any_of(outcome_.corrected.begin(), outcome_.corrected.end(),
                      [&](const EditedFile& other) { return other.path == file.path; });
      if (!known) {
        outcome_.corrected.push_back(std::move(file));
      }
    }
    return !files.empty();
  }

  const Globals& globals_;
  const CheckArguments& options_;
  Report& report_;
  Outcome outcome_;
  std::set<std::tuple<std::string, std::uint32_t, std::uint32_t, std::string, std::string,
                      std::string, std::string>>
      known_;
};

Counts count(const std::vector<ReportedFinding>& findings) {
  Counts counts;
  for (const ReportedFinding& reported : findings) {
    if (reported.suppressed) {
      ++counts.suppressed;
      continue;
    }
    const Severity severity = reported.finding.diagnostic.severity;
    ++(severity == Severity::Error     ? counts.errors
       : severity == Severity::Warning ? counts.warnings
                                       : counts.infos);
    counts.fixable += reported.finding.fix ? 1 : 0;
  }
  return counts;
}

Json finding_json(const ReportedFinding& reported) {
  const check::Finding& finding = reported.finding;
  Json item = diagnostic_json(finding.diagnostic);
  item["variants"] = finding.variants.empty() ? Json(nullptr) : Json(finding.variants);
  const bool numbered = finding.rule != nullptr && !finding.rule->numbers.empty();
  item["numbers"] = numbered ? Json(finding.rule->numbers) : Json(nullptr);
  item["autofix"] = finding.fix ? Json(finding.fix->what) : Json(nullptr);
  item["suppressed"] = reported.suppressed;
  return item;
}

/// The files that --fix changes, with what changes in those that are text.
Json corrected_json(const Outcome& outcome) {
  Json files = Json::array();
  for (const EditedFile& file : outcome.corrected) {
    Json item = {{"file", shown_path(file.path)}};
    item["diff"] = file.text ? Json(unified_diff(shown_path(file.path), file.before, file.after))
                             : Json(nullptr);
    files.push_back(std::move(item));
  }
  return files;
}

Json body_of(const Outcome& outcome, const Counts& counts, const CheckArguments& options) {
  Json body = Json::object();
  body["diagnostics"] = Json::array();
  for (const ReportedFinding& reported : outcome.findings) {
    body["diagnostics"].push_back(finding_json(reported));
  }
  body["summary"] = {{"errors", counts.errors},
                     {"warnings", counts.warnings},
                     {"infos", counts.infos},
                     {"fixable", counts.fixable},
                     {"suppressed", counts.suppressed}};
  body["assets"] = outcome.assets;
  if (options.fix) {
    body[options.dry_run ? "wouldCorrect" : "corrected"] = corrected_json(outcome);
  }
  return body;
}

void print_findings(const Outcome& outcome, const Globals& globals, bool to_stderr) {
  const bool color = use_color(globals, to_stderr ? stderr_is_terminal() : stdout_is_terminal());
  std::vector<Remark> findings;
  for (const ReportedFinding& reported : outcome.findings) {
    const Severity severity = reported.finding.diagnostic.severity;
    const bool shown = severity == Severity::Error ||
                       (severity == Severity::Warning && !globals.quiet) || globals.verbose;
    if (!reported.suppressed && shown) {
      const std::vector<std::string>& variants = reported.finding.variants;
      findings.push_back({&reported.finding.diagnostic,
                          variants.empty() ? "" : " (Physics=" + joined(variants) + ")"});
    }
  }
  for (const std::string& line : diagnostic_lines(findings, color, globals.verbose)) {
    to_stderr ? say_aside(line) : print_colored(line + "\n");
  }
}

std::string counted(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string summary_of(const Counts& counts, const Outcome& outcome,
                       const CheckArguments& options) {
  std::string text = counted(counts.errors, "error") + ", " + counted(counts.warnings, "warning") +
                     ", " + counted(counts.infos, "info") + " in " +
                     counted(outcome.assets.size(), "asset");
  if (counts.suppressed > 0) {
    text += ", " + std::to_string(counts.suppressed) + " known";
  }
  if (options.fix) {
    text += "; " + counted(outcome.corrected.size(), "file") +
            (options.dry_run ? " would be corrected" : " corrected");
  } else if (counts.fixable > 0) {
    text += "; --fix corrects " + std::to_string(counts.fixable);
  }
  return text;
}

Result<void> claim_reports(const CheckArguments& options, Outputs& outputs) {
  TENON_CHECK(outputs.claim(OutputKind::Sarif, options.sarif));
  return outputs.claim(OutputKind::Baseline, options.write_baseline);
}

Result<void> write_reports(const Outcome& outcome, const CheckArguments& options,
                           Outputs& outputs) {
  if (!options.sarif.empty()) {
    const std::string text =
        sarif_log(outcome.findings).dump(2, ' ', false, Json::error_handler_t::replace);
    outputs.put(options.sarif, text + "\n");
  }
  if (!options.write_baseline.empty()) {
    outputs.put(options.write_baseline,
                Baseline::text_of(outcome.findings, options.write_baseline));
  }
  return outputs.commit();
}

void print_outcome(const Outcome& outcome, const Counts& counts, const CheckArguments& options,
                   const Globals& globals, const Report& report) {
  const bool diff = options.fix && options.dry_run;
  for (const EditedFile& file : outcome.corrected) {
    if (diff && file.text) {
      const std::string name = shown_path(file.path);
      print_data(unified_diff(name, file.before, file.after));
    } else {
      report.note((diff ? "would correct " : "corrected ") + shown_path(file.path));
    }
    if (!file.kept_layout) {
      report.note("comments and layout of " + shown_path(file.path) + " are not kept");
    }
  }
  if (options.sarif != "-" && options.write_baseline != "-") {
    print_findings(outcome, globals, diff);
  }
  report.note(summary_of(counts, outcome, options));
}

int check_assets(const Globals& globals, const CheckArguments& options) {
  Report report(globals, "check", options.paths.front());
  Outputs outputs;
  if (auto claimed = claim_reports(options, outputs); !claimed) {
    return report.fail(claimed.error());
  }
  auto outcome = Run(globals, options, report).all_assets();
  if (!outcome) {
    return report.fail(outcome.error());
  }
  if (auto written = write_reports(*outcome, options, outputs); !written) {
    return report.fail(written.error());
  }
  const Counts counts = count(outcome->findings);
  const bool found = counts.errors > 0 || (options.strict && counts.warnings > 0);
  const int code = outcome->failed ? kFailed : (found ? kNo : kOk);
  if (!report.json()) {
    print_outcome(*outcome, counts, options, globals, report);
  }
  return report.finish(code, report.json() ? body_of(*outcome, counts, options) : Json::object());
}

int list_rules(const Globals& globals) {
  Report report(globals, "check", "");
  Json list = Json::array();
  for (const check::Rule& rule : check::rules()) {
    const std::string title = check::title_of(check::page_of(rule.id));
    if (!globals.json) {
      print("%-40s %-8s %-14s %s %s\n", std::string(rule.id).c_str(),
            std::string(severity_name(rule.severity)).c_str(), std::string(rule.numbers).c_str(),
            rule.fix == nullptr ? "   " : "fix", title.c_str());
    }
    list.push_back({{"rule", rule.id},
                    {"severity", severity_name(rule.severity)},
                    {"numbers", rule.numbers},
                    {"autofix", rule.fix != nullptr},
                    {"title", title}});
  }
  return report.finish(kOk, globals.json ? Json{{"rules", list}} : Json::object());
}

int explain_rule(const Globals& globals, const std::string& id) {
  Report report(globals, "check", "");
  const std::string_view page = check::page_of(id);
  if (page.empty()) {
    return report.fail(Error(ErrorCode::NotFound, "there is no rule \"" + id + "\"")
                           .with_fix("tenon check --list-rules names all"));
  }
  if (!globals.json) {
    print_text(page);
  }
  return report.finish(kOk, globals.json ? Json{{"rule", id}, {"page", page}} : Json::object());
}

Result<void> check_arguments(const CheckArguments& options, bool json) {
  if (json && (options.sarif == "-" || options.write_baseline == "-")) {
    return Error(ErrorCode::Invalid, "--json and another output both want standard output")
        .with_fix("write the SARIF log or the baseline to a file");
  }
  if (options.paths.empty()) {
    return Error(ErrorCode::Invalid, "nothing to check")
        .with_fix("name files or folders, or give --list-rules or --explain RULE");
  }
  if (options.dry_run && !options.fix) {
    return Error(ErrorCode::Invalid, "--dry-run shows what --fix would do").with_fix("add --fix");
  }
  for (const auto* list : {&options.rules.only, &options.rules.skip}) {
    for (const std::string& name : *list) {
      const bool known =
          std::any_of(check::rules().begin(), check::rules().end(), [&](const check::Rule& rule) {
            return rule.id == check::current_id(name) ||
                   rule.id.substr(0, rule.id.find('.')) == name;
          });
      if (!known && check::page_of(name).empty()) {
        return Error(ErrorCode::NotFound, "there is no rule or family of rules \"" + name + "\"")
            .with_fix("tenon check --list-rules names all");
      }
    }
  }
  return {};
}

int run_check(const Globals& globals, const CheckArguments& options) {
  if (options.list_rules) {
    return list_rules(globals);
  }
  if (!options.explain.empty()) {
    return explain_rule(globals, options.explain);
  }
  if (auto usable = check_arguments(options, globals.json); !usable) {
    return Report(globals, "check", "").fail(usable.error());
  }
  return check_assets(globals, options);
}

constexpr const char* kCheckFooter =
    "Errors give exit code 1, with --strict warnings too; infos show with -v.\n"
    "All variants of the default prim's set \"Physics\" are looked at; --physics V takes one.\n"
    "Of a folder, the files that no other file in it uses as a layer are checked.\n\n"
    "Examples:\n"
    "  tenon check hand.usda\n"
    "  tenon check assets/ --strict --baseline known.json\n"
    "  tenon check hand.usda --fix --dry-run\n"
    "  tenon check hand.usda --profile isaac-3.0\n"
    "  tenon check hand.usda --skip collider.overlap-at-start,units --sarif hand.sarif\n"
    "  tenon check --explain mass.inertia-triangle";

}  // namespace

void add_check(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb =
      parent.add_subcommand("check", "What is wrong with assets, and how to correct it");
  auto options = std::make_shared<CheckArguments>();
  verb.add_option("assets", options->paths, "USD files or folders").file_only();
  options->asset.add_options_to(verb);
  verb.add_flag("--fix", options->fix, "Correct what has a safe fix, in the files that own it");
  verb.add_flag("--dry-run", options->dry_run, "With --fix: print the difference, write nothing");
  verb.add_flag("--strict", options->strict, "Warnings count as errors for the exit code");
  add_readings(verb, options->readings);
  verb.add_option("--profile", options->profile,
                  "Hold the files to this structure of assets as well")
      .one_of({"isaac-3.0"});
  verb.add_option("--only", options->rules.only,
                  "These rules or families alone (mass, joint.body-missing)")
      .split_at_commas();
  verb.add_option("--skip", options->rules.skip, "Not these rules or families").split_at_commas();
  verb.add_option("--sarif", options->sarif, "Write a SARIF 2.1.0 log; - is standard output");
  verb.add_option("--baseline", options->baseline, "Findings in this file are known");
  verb.add_option("--write-baseline", options->write_baseline,
                  "Write all findings to a baseline for later runs");
  verb.add_flag("--list-rules", options->list_rules, "Name all rules");
  verb.add_option("--explain", options->explain, "Print the page of a rule");
  verb.footer(kCheckFooter);
  choose(verb, chosen, [&globals, options] { return run_check(globals, *options); });
}

}  // namespace tenon::cli
