// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "cli/output.h"
#include "cli/report.h"
#include "cli/text/where_text.h"
#include "cli/verb.h"
#include "tenon/answers/where_opinions.h"
#include "tenon/tenon.h"

namespace tenon::cli {
namespace {

constexpr const char* kPhysics = "Physics";

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
        .with_fix("write it from the root, as in /hand/palm.physics:mass");
  }
  return path->is_property() ? SoughtObject{path->parent(), path->name()} : SoughtObject{*path, {}};
}

Result<stage::Prim> find(const stage::Stage& stage, const SoughtObject& object) {
  const stage::Prim prim = stage.prim(object.prim);
  if (!prim) {
    return Error(ErrorCode::NotFound, "there is no prim <" + object.prim.str() + ">")
        .with_fix("tenon tree lists all prims");
  }
  const bool known = object.property.empty() || prim.has_property(object.property) ||
                     prim.is_relationship(object.property) ||
                     prim.attribute(object.property).definition() != nullptr;
  if (!known) {
    return Error(ErrorCode::NotFound,
                 "<" + object.prim.str() + "> has no property " + object.property.str())
        .with_fix("tenon tree --attributes lists all properties");
  }
  return prim;
}

/// Opinions under the variants of "Physics" that are not selected.
Result<void> add_variants(const stage::Stage& stage, const SoughtObject& object,
                          const WhereArguments& options, Json& answer) {
  const stage::Prim root = stage.default_prim();
  if (!root) {
    return {};
  }
  for (const std::string& variant : root.variant_names(kPhysics)) {
    if (variant == root.variant_selection(kPhysics)) {
      continue;
    }
    OpenOptions open = options.asset.open_options();
    open.physics_variant = variant;
    Diagnostics known;  // the first stage has reported them
    TENON_TRY(const stage::Stage other, open_stage(options.asset.asset, open, known));
    if (const stage::Prim prim = other.prim(object.prim)) {
      answers::add_other_variant(answer,
                                 answers::where_json(other, prim, object.property, options.time),
                                 std::string(kPhysics) + "=" + variant);
    }
  }
  return {};
}

int run_where(const Globals& globals, const WhereArguments& options) {
  Report report(globals, "where", options.asset.asset);
  const auto object = parse_object(options.object);
  if (!object) {
    return report.fail(object.error());
  }
  auto stage = open_stage(options.asset.asset, options.asset.open_options(), report.diagnostics);
  if (!stage) {
    return report.fail(stage.error());
  }
  const auto prim = find(*stage, *object);
  if (!prim) {
    return report.fail(prim.error());
  }
  Json answer = answers::where_json(*stage, *prim, object->property, options.time);
  if (options.variants) {
    if (auto added = add_variants(*stage, *object, options, answer); !added) {
      return report.fail(added.error());
    }
  }
  if (!report.json()) {
    print_text(where_text(answer));
  }
  return report.finish(kOk, answer);
}

}  // namespace

void add_where(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "where", "Every file that speaks about a property or prim, and which of them counts");
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
