// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What is found and what fixes change is the work of tenon/asset/checking. Reports are claimed
// before it and written together after it. The exit code looks at what no baseline knows.
#include <cstdio>
#include <set>

#include "cli/output.h"
#include "cli/progress.h"
#include "cli/reading_options.h"
#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/answers/diagnostic_json.h"
#include "tenon/asset/check_asset.h"
#include "tenon/asset/checking/baseline.h"
#include "tenon/asset/checking/check_assets.h"
#include "tenon/asset/checking/checked_json.h"
#include "tenon/asset/checking/sarif.h"
#include "tenon/base/text/comma_list.h"
#include "tenon/base/text/counted.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/check/rule.h"
#include "tenon/diff/unified_diff.h"

namespace tenon::cli {
namespace {

struct CheckArguments {
  std::vector<std::string> paths;
  AssetArguments asset;
  check::Selection rules;
  std::vector<std::string> readings;  ///< --reading NAME=VALUE
  std::string profile;
  bool fix = false;
  bool suggested = false;
  bool dry_run = false;
  bool strict = false;
  bool list_rules = false;
  std::string explain;
  std::string sarif;
  std::string baseline;
  std::string write_baseline;
};

Result<CheckAssetsOptions> check_options(const Globals& globals, const CheckArguments& options) {
  CheckAssetsOptions wanted;
  wanted.check.open = options.asset.open_options();
  wanted.check.rules = options.rules;
  wanted.check.profile = options.profile;
  TENON_TRY(wanted.check.readings, chosen_readings(options.readings));
  wanted.correct = options.fix;
  wanted.suggested = options.suggested;
  if (!options.dry_run) {
    wanted.write = [](const std::string& asset, const std::vector<EditedFile>& files) {
      Outputs outputs = Outputs::in_place({"check --fix", asset});
      for (const EditedFile& file : files) {
        outputs.put(file.path, file.after);
      }
      return outputs.commit();
    };
  }
  wanted.baseline = options.baseline;
  wanted.read_settings = !globals.no_settings;
  return wanted;
}

Result<CheckedAssets> check_all(const Globals& globals, const CheckArguments& options) {
  TENON_TRY(CheckAssetsOptions wanted, check_options(globals, options));
  Progress progress(globals, "checking");
  wanted.progress = [&](std::size_t done, std::size_t total) {
    progress.at(static_cast<double>(done), static_cast<double>(total), "assets");
  };
  return check_assets(options.paths, wanted);
}

void print_findings(const CheckedAssets& outcome, const Globals& globals, bool to_stderr) {
  const bool color = use_color(globals, to_stderr ? stderr_is_terminal() : stdout_is_terminal());
  std::vector<Remark> findings;
  for (const ReportedFinding& reported : outcome.findings) {
    const Severity severity = reported.finding.diagnostic.severity;
    const bool shown = severity == Severity::Error ||
                       (severity == Severity::Warning && !globals.quiet) || globals.verbose;
    if (!reported.suppressed && shown) {
      const std::vector<std::string>& variants = reported.finding.variants;
      findings.push_back({&reported.finding.diagnostic,
                          variants.empty() ? "" : " (Physics=" + comma_list(variants) + ")"});
    }
  }
  for (const std::string& line : diagnostic_lines(findings, color, globals.verbose)) {
    to_stderr ? say_aside(line) : print_colored(line + "\n");
  }
}

std::string summary_of(const FindingCounts& counts, const CheckedAssets& outcome,
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
  if (!options.suggested && counts.suggested > 0) {
    text += "; --fix --suggested renames " + std::to_string(counts.suggested) +
            (counts.fixable > 0 && !options.fix ? " more" : "");
  }
  return text;
}

/// Which settings files held, and what they skipped.
void tell_settings(const CheckedAssets& outcome, const Report& report) {
  std::set<std::string> told;
  for (const AssetChecked& asset : outcome.assets) {
    if (!asset.settings.empty() && report.verbose() && told.insert(asset.settings).second) {
      report.note("settings: " + shown_path(asset.settings));
    }
  }
  for (const SkippedFindings& skipped : outcome.skipped) {
    report.note("skipped by " + shown_path(skipped.settings) + ": " + skipped.rule + " (" +
                skipped.reason + ") x " + std::to_string(skipped.count));
  }
}

Result<void> claim_reports(const CheckArguments& options, Outputs& outputs) {
  TENON_CHECK(outputs.claim(OutputKind::Sarif, options.sarif));
  return outputs.claim(OutputKind::Baseline, options.write_baseline);
}

Result<void> write_reports(const CheckedAssets& outcome, const CheckArguments& options,
                           Outputs& outputs) {
  if (!options.sarif.empty()) {
    outputs.put(options.sarif, answers::printed(sarif_log(outcome.findings, TENON_VERSION,
                                                          options.asset.open_options().files)));
  }
  if (!options.write_baseline.empty()) {
    outputs.put(options.write_baseline,
                Baseline::text_of(outcome.findings, options.write_baseline));
  }
  return outputs.commit();
}

void print_outcome(const CheckedAssets& outcome, const FindingCounts& counts,
                   const CheckArguments& options, const Globals& globals, const Report& report) {
  const bool diff = options.fix && options.dry_run;
  for (const EditedFile& file : outcome.corrected) {
    if (diff && file.text) {
      const std::string name = shown_path(file.path);
      print_data(diff::unified_diff(name, file.before, file.after));
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
  tell_settings(outcome, report);
  report.note(summary_of(counts, outcome, options));
}

int check_assets(const Globals& globals, const CheckArguments& options) {
  Report report(globals, "check", options.paths.front());
  Outputs outputs;
  if (auto claimed = claim_reports(options, outputs); !claimed) {
    return report.fail(claimed.error());
  }
  const auto outcome = check_all(globals, options);
  if (!outcome) {
    return report.fail(outcome.error());
  }
  if (auto written = write_reports(*outcome, options, outputs); !written) {
    return report.fail(written.error());
  }
  const FindingCounts counts = count_findings(outcome->findings);
  const bool found = counts.errors > 0 || (options.strict && counts.warnings > 0);
  const int code = !outcome->all_opened() ? kFailed : (found ? kNo : kOk);
  if (!report.json()) {
    print_outcome(*outcome, counts, options, globals, report);
  }
  const char* corrected = !options.fix ? "" : options.dry_run ? "wouldCorrect" : "corrected";
  return report.finish(code,
                       report.json() ? checked_json(*outcome, corrected) : answers::nothing());
}

int list_rules(const Globals& globals) {
  Report report(globals, "check", "");
  if (!globals.json) {
    for (const check::Rule& rule : check::rules()) {
      print("%-40s %-8s %-14s %s %s\n", std::string(rule.id).c_str(),
            std::string(severity_name(rule.severity)).c_str(), std::string(rule.numbers).c_str(),
            rule.fix == nullptr ? "   " : "fix", check::title_of(check::page_of(rule.id)).c_str());
    }
  }
  return report.finish(kOk, rules_json());
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
  return report.finish(kOk, answers::rule_page_json(id, page));
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
  if (options.suggested && !options.fix) {
    return Error(ErrorCode::Invalid, "--suggested says what --fix corrects").with_fix("add --fix");
  }
  return check_selection(options.rules);
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
    "Of a folder, the files that no other file in it uses as a layer are checked; symbolic links\n"
    "to folders are not followed.\n"
    "tenon.toml in a repository may skip rules (tenon help settings); --no-settings ignores it.\n\n"
    "Examples:\n"
    "  tenon check hand.usda\n"
    "  tenon check assets/ --strict --baseline known.json\n"
    "  tenon check hand.usda --fix --dry-run\n"
    "  tenon check hand.usda --fix --suggested\n"
    "  tenon check hand.usda --profile isaac-3.0\n"
    "  tenon check hand.usda --profile simready --only simready\n"
    "  tenon check hand.usda --for physx,newton\n"
    "  tenon check hand.usda --skip collider.overlap-at-start,units --sarif hand.sarif\n"
    "  tenon check --explain mass.inertia-triangle";

}  // namespace

void add_check(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand("check", "Validate assets and suggest fixes");
  auto options = std::make_shared<CheckArguments>();
  verb.add_option("assets", options->paths, "USD files or folders").file_only();
  options->asset.add_options_to(verb);
  verb.add_flag("--fix", options->fix,
                "Correct what has a safe fix, in the files of the asset that own it");
  verb.add_flag("--suggested", options->suggested,
                "With --fix: also the names and types that messages suggest");
  verb.add_flag("--dry-run", options->dry_run, "With --fix: print the difference, write nothing");
  verb.add_flag("--strict", options->strict, "Warnings count as errors for the exit code");
  add_readings(verb, options->readings);
  verb.add_option("--for", options->rules.engines,
                  "Differences of these engines where they read the asset themselves, not by "
                  "tenon sim --engine: rules of the family portability")
      .split_at_commas()
      .one_of(check::known_engines());
  verb.add_option(
          "--profile", options->profile,
          "Hold the files to this structure of assets, or to these requirements, as well; without "
          "it that of tenon.toml")
      .one_of(check::known_profiles());
  verb.add_option("--only", options->rules.only,
                  "The only rules or families to check (mass, joint.body-missing)")
      .split_at_commas();
  verb.add_option("--skip", options->rules.skip, "Rules or families to skip").split_at_commas();
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
