// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <utility>

#include "cli/output.h"
#include "cli/report.h"
#include "cli/text/where_text.h"
#include "cli/verb.h"
#include "tenon/answers/where_opinions.h"
#include "tenon/asset/answers/where_variants.h"
#include "tenon/open_stage.h"

namespace tenon::cli {
namespace {

struct WhereArguments {
  AssetArguments asset;
  std::string object;
  std::optional<double> time;
  bool variants = false;
};

struct SoughtObject {
  Path prim;
  Token property;  ///< empty: the prim itself
};

Result<SoughtObject> parse_object(const std::string& text) {
  const auto path = Path::parse(text);
  if (!path || !path->is_absolute() || path->has_variants() ||
      !(path->is_prim_or_root() || path->kind() == PathKind::Property)) {
    return Error(ErrorCode::Invalid, "\"" + text + "\" is not the path of a prim or property")
        .with_fix(
            "write it from the root, as in /hand/palm.physics:mass; tenon tree lists all prims");
  }
  return path->is_property() ? SoughtObject{path->parent(), path->name()} : SoughtObject{*path, {}};
}

Result<stage::Prim> find(const stage::Stage& stage, const SoughtObject& object) {
  const stage::Prim prim = stage.prim(object.prim);
  if (!prim) {
    return Error(ErrorCode::NotFound, "there is no prim <" + object.prim.str() + ">")
        .with_fix("tenon tree lists all prims");
  }
  if (!object.property.empty()) {
    TENON_CHECK(answers::check_property(prim, object.property));
  }
  return prim;
}

int run_where(const Globals& globals, const WhereArguments& options) {
  Report report(globals, "where", options.asset.asset);
  const auto object = parse_object(options.object);
  if (!object) {
    return report.fail(object.error());
  }
  auto stage = tenon::open(options.asset.asset, options.asset.open_options(), report.diagnostics);
  if (!stage) {
    return report.fail(stage.error());
  }
  const auto prim = find(*stage, *object);
  if (!prim) {
    return report.fail(prim.error());
  }
  Json answer = answers::where_json(*stage, *prim, object->property, options.time);
  if (options.variants) {
    const auto added =
        add_other_variants({*stage, options.asset.asset, options.asset.open_options()},
                           {object->prim, object->property, options.time}, answer);
    if (!added) {
      return report.fail(added.error());
    }
  }
  if (!report.json()) {
    print_text(where_text(answer));
  }
  return report.finish(kOk, std::move(answer));
}

}  // namespace

void add_where(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "where", "Every file that sets a property or defines a prim, and which wins");
  auto options = std::make_shared<WhereArguments>();
  options->asset.add_with_standard_input_to(verb);
  verb.add_option("object", options->object, "PRIM.property, or PRIM for its own fields")
      .required();
  verb.add_option("--time", options->time, {-1e9, 1e9, false, false, ""},
                  "The time code of what counts at times");
  verb.add_flag("--variants", options->variants,
                "Also what other variants of \"Physics\" would bring in");
  verb.footer(
      "Opinions stand strongest first, with file, line, the arcs that lead there, and why one "
      "loses.\n\nExamples:\n"
      "  tenon where hand.usda /hand/Physics/thumb_joint.physics:upperLimit\n"
      "  tenon where hand.usda /hand/palm                  type, API schemas, arcs, metadata\n"
      "  tenon where hand.usda /hand/palm.physics:mass --variants --json");
  choose(verb, chosen, [&globals, options] { return run_where(globals, *options); });
}

}  // namespace tenon::cli
