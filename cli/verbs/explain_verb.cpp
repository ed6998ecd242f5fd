// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <utility>

#include "cli/nearest_name.h"
#include "cli/output.h"
#include "cli/reading_options.h"
#include "cli/report.h"
#include "cli/text/explain_text.h"
#include "cli/text/rule_numbers.h"
#include "cli/verb.h"
#include "tenon/answers/diagnostic_json.h"
#include "tenon/answers/explain.h"
#include "tenon/asset/answers/explained_stage.h"
#include "tenon/check/rule.h"

namespace tenon::cli {
namespace {

struct ExplainArguments {
  AssetArguments asset;
  std::string object;
  std::string other;
  std::vector<std::string> readings;
};

/// `tenon explain S-83`, `tenon explain joint.body-missing`: what a rule says.
int explain_rule_or_finding(const Globals& globals, const std::string& rule) {
  Report report(globals, "explain", "");
  std::string text;
  if (is_rule_number(rule)) {
    text = rule_with_number(rule).value_or("");
  } else {
    text = check::page_of(rule);
  }
  if (text.empty()) {
    std::vector<std::string> names;
    for (const check::Rule& known : check::rules()) {
      names.emplace_back(known.id);
    }
    return report.fail(
        Error(ErrorCode::NotFound, "explain needs an asset and a prim, or a rule; \"" + rule +
                                       "\" is neither the number nor the name of a rule")
            .with_rule("usage.missing-argument")
            .with_fix(did_you_mean(rule, names,
                                   "write `tenon explain FILE PRIM` or `tenon explain RULE`; "
                                   "`tenon check --list-rules` names all rules")));
  }
  if (!report.json()) {
    print_text(is_rule_number(rule) ? rule + ": " + text + "\n" : text);
  }
  return report.finish(kOk, answers::rule_page_json(rule, text));
}

int run_explain(const Globals& globals, const ExplainArguments& options) {
  Report report(globals, "explain", options.asset.asset);
  const auto asset = open_with_readings(options.asset, options.readings, report.diagnostics);
  if (!asset) {
    return report.fail(asset.error());
  }
  if (const auto found = answers::check_object(asset->stage, options.object); !found) {
    return report.fail(found.error());
  }
  const auto explained = explained_stage(asset->stage, asset->readings, report.diagnostics);
  auto answer = answers::explain_object(explained, options.object, options.other);
  if (!answer) {
    return report.fail(answer.error());
  }
  if (!report.json()) {
    print_text(!options.other.empty()                     ? explain_pair_text(*answer)
               : Path::from(options.object).is_property() ? explain_property_text(*answer)
                                                          : explain_prim_text(*answer));
  }
  return report.finish(kOk, *std::move(answer));
}

}  // namespace

void add_explain(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "explain", "Where a number comes from: file and line, rule, weaker opinions");
  auto options = std::make_shared<ExplainArguments>();
  options->asset.add_with_standard_input_to(verb);
  verb.option("asset").description("A USD file, - for standard input; or a rule alone");
  verb.add_option("object", options->object, "PRIM or PRIM.property; without it a rule is meant");
  verb.add_option("other", options->other, "A second prim: do the two collide, and why not");
  add_readings(verb, options->readings);
  verb.footer(
      readings_help() +
      "\n\nExamples:\n  tenon explain hand.usda /hand/palm                    its mass, its "
      "joints\n"
      "  tenon explain hand.usda /hand/palm.physics:mass       every opinion, strongest first\n"
      "  tenon explain hand.usda /hand/palm /hand/thumb        whether they collide, and why not\n"
      "  tenon explain S-83                                    the numbered rule in a message\n"
      "  tenon explain joint.body-missing                      the rule in brackets behind one");
  choose(verb, chosen, [&globals, options] {
    return options->object.empty() ? explain_rule_or_finding(globals, options->asset.asset)
                                   : run_explain(globals, *options);
  });
}

}  // namespace tenon::cli
