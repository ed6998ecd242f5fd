// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "cli/output.h"
#include "cli/reading_options.h"
#include "cli/report.h"
#include "cli/text/explain_text.h"
#include "cli/text/rule_numbers.h"
#include "cli/verb.h"
#include "tenon/answers/diagnostic_json.h"
#include "tenon/answers/explain.h"
#include "tenon/answers/where_opinions.h"
#include "tenon/asset/physics_options.h"
#include "tenon/check/rule.h"
#include "tenon/physics/read_physics.h"
#include "tenon/tenon.h"

namespace tenon::cli {
namespace {

struct ExplainArguments {
  AssetArguments asset;
  std::string object;
  std::string other;
  std::vector<std::string> readings;
};

struct ExplainedObject {
  stage::Prim prim;
  Token property;  ///< empty: the prim itself
};

Result<ExplainedObject> find_object(const stage::Stage& stage, const std::string& text) {
  const Path path = Path::from(text);
  const Path prim_path = path.is_property() ? path.parent() : path;
  const stage::Prim prim =
      path.is_prim() || path.is_property() ? stage.prim(prim_path) : stage::Prim();
  if (!prim) {
    return Error(ErrorCode::NotFound, "there is no prim <" + text + ">")
        .with_fix("tenon tree lists all prims");
  }
  ExplainedObject object{prim, path.is_property() ? path.name() : Token()};
  if (path.is_property()) {
    TENON_CHECK(answers::check_property(prim, object.property));
  }
  return object;
}

int explain_two(Report& report, const answers::Explained& explained, const ExplainedObject& a,
                const ExplainArguments& options) {
  auto other = find_object(explained.stage, options.other);
  if (!other) {
    return report.fail(other.error());
  }
  const Json answer = answers::explain_pair(explained, a.prim, other->prim);
  if (!report.json()) {
    print_text(explain_pair_text(answer));
  }
  return report.finish(kOk, answer);
}

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
    return report.fail(
        Error(ErrorCode::NotFound, "explain needs an asset and a prim, or a rule; \"" + rule +
                                       "\" is neither the number nor the name of a rule")
            .with_rule("usage.missing-argument")
            .with_fix("write `tenon explain FILE PRIM` or `tenon explain RULE`; `tenon check "
                      "--list-rules` names all rules"));
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
  auto object = find_object(asset->stage, options.object);
  if (!object) {
    return report.fail(object.error());
  }
  answers::Explained explained{asset->stage, {}, {}};
  explained.scene = physics::read_physics(asset->stage, read_options(asset->readings),
                                          report.diagnostics, &explained.provenance);
  if (!options.other.empty()) {
    return explain_two(report, explained, *object, options);
  }
  const bool property = !object->property.empty();
  const Json answer = property
                          ? answers::explain_property(explained, object->prim, object->property)
                          : answers::explain_prim(explained, object->prim);
  if (!report.json()) {
    print_text(property ? explain_property_text(answer) : explain_prim_text(answer));
  }
  return report.finish(kOk, answer);
}

}  // namespace

void add_explain(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "explain", "Where a number comes from: layer and line, rule, and what lost to it");
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
