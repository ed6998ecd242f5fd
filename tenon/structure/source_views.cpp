// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/structure/source_views.h"

#include <algorithm>

#include "tenon/stage/stage.h"
#include "tenon/structure/content.h"

namespace tenon::structure {
namespace {

Result<stage::Stage> open_view(const AssetSource& source, const Selections& selections) {
  stage::StageOptions options;
  options.resolve_asset = source.resolve_asset;
  return stage::Stage::open(source.root, selections_layer(source.root->default_prim(), selections),
                            source.open_layer, options);
}

Result<layer::Layer> view_content(const AssetSource& source, const Selections& selections) {
  TENON_TRY(const stage::Stage stage, open_view(source, selections));
  return content_of(stage);
}

/// The selected view, else that of the strongest engine.
std::size_t choose(const SourceViews& views) {
  for (const std::string_view name :
       {std::string_view(views.selection), std::string_view("physx"), std::string_view("mujoco"),
        std::string_view("newton"), std::string_view("physics")}) {
    for (std::size_t i = 0; i < views.physics.size(); ++i) {
      if (views.physics[i].variant == name && name != kNoVariant) {
        return i;
      }
    }
  }
  for (std::size_t i = 0; i < views.physics.size(); ++i) {
    if (views.physics[i].variant != kNoVariant) {
      return i;
    }
  }
  return 0;
}

void report_lost_variants(const stage::Stage& stage, Diagnostics& diagnostics) {
  std::vector<stage::Prim> pending{stage.pseudo_root()};
  while (!pending.empty()) {
    const stage::Prim prim = pending.back();
    pending.pop_back();
    if (prim != stage.default_prim() && !prim.variant_set_names().empty()) {
      Diagnostic lost = prim.located(
          Severity::Warning, "structure.variants-flattened",
          "the variant set \"" + prim.variant_set_names().front() +
              "\" is not on the default prim: what it selects stays, the other variants go");
      lost.fix = "move the variant set to the default prim";
      diagnostics.add(std::move(lost));
    }
    if (!prim.is_instance()) {
      const std::vector<stage::Prim> children = prim.children();
      pending.insert(pending.end(), children.rbegin(), children.rend());
    }
  }
}

Error no_default_prim(const layer::Layer& root) {
  return Error(ErrorCode::NotFound, "the asset has no default prim, which is to become the robot")
      .in_file(root.identifier())
      .with_rule("stage.default-prim-missing")
      .with_fix("author defaultPrim with the name of the root prim");
}

struct Variants {
  std::vector<std::string> physics;
  std::vector<std::pair<std::string, std::string>> others;
  Selections none;  ///< no variant of any set
};

Result<Variants> read_variants(const AssetSource& source, SourceViews& views,
                               Diagnostics& diagnostics) {
  TENON_TRY(const stage::Stage stage, open_view(source, {}));
  const stage::Prim robot = stage.default_prim();
  if (!robot) {
    return no_default_prim(*source.root);
  }
  report_lost_variants(stage, diagnostics);
  Variants variants;
  views.robot = robot.name();
  for (const std::string& set : robot.variant_set_names()) {
    variants.none[set] = "";
    if (set == kPhysicsSet) {
      variants.physics = robot.variant_names(set);
      views.selection = robot.variant_selection(set);
      continue;
    }
    views.set_order.push_back(set);
    views.other_selections[set] = robot.variant_selection(set);
    for (const std::string& variant : robot.variant_names(set)) {
      variants.others.emplace_back(set, variant);
    }
  }
  return variants;
}

}  // namespace

const SourceView* SourceViews::find(std::string_view variant) const {
  const auto found = std::find_if(physics.begin(), physics.end(),
                                  [&](const SourceView& view) { return view.variant == variant; });
  return found == physics.end() ? nullptr : &*found;
}

Result<SourceViews> read_views(const AssetSource& source, Diagnostics& diagnostics) {
  SourceViews views;
  TENON_TRY(const Variants variants, read_variants(source, views, diagnostics));
  const bool plain = variants.physics.empty();
  for (const std::string& variant :
       plain ? std::vector<std::string>{std::string()} : variants.physics) {
    Selections selections = variants.none;
    if (!plain) {
      selections[std::string(kPhysicsSet)] = variant;
    }
    TENON_TRY(layer::Layer content, view_content(source, selections));
    views.physics.push_back({variant, std::move(content)});
  }
  views.chosen = choose(views);
  for (const auto& [set, variant] : variants.others) {
    Selections selections = variants.none;
    selections[set] = variant;
    if (!plain) {
      selections[std::string(kPhysicsSet)] = views.physics[views.chosen].variant;
    }
    TENON_TRY(layer::Layer content, view_content(source, selections));
    views.others.push_back({set, variant, std::move(content)});
  }
  return views;
}

}  // namespace tenon::structure
