// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The source is composed under each variant of "Physics" with all other sets off, then under each
// variant of another set with the chosen physics. The number of views is the sum of the variants
// and not their product, because each other variant is kept as a change of one view. Targets
// outside the default prim are dropped from every view, since a reference to the asset drops them.
#include "tenon/structure/make/source_views.h"

#include <algorithm>
#include <set>

#include "tenon/layer/fields.h"
#include "tenon/stage/stage.h"
#include "tenon/stage/work_account.h"
#include "tenon/structure/layer_tree.h"
#include "tenon/structure/layout.h"
#include "tenon/structure/proof/content.h"

namespace tenon::structure {
namespace {

/// Composes the views of one source: what that takes is counted together, and what it finds is said
/// once, whatever number of views have it.
class Composer {
 public:
  Composer(const AssetSource& source, Diagnostics& diagnostics)
      : source_(source), work_(source.max_work), diagnostics_(diagnostics) {}

  Result<stage::Stage> open(const Selections& selections) {
    stage::StageOptions options;
    options.resolve_asset = source_.resolve_asset;
    options.compose.set_max_work(source_.max_work);
    TENON_TRY(
        stage::Stage stage,
        stage::Stage::open(source_.root, selections_layer(source_.root->default_prim(), selections),
                           source_.open_layer, options));
    TENON_CHECK(work_.spend(stage));
    report(stage);
    return stage;
  }

  Result<layer::Layer> content(const Selections& selections, std::map<Path, Path>& moved) {
    TENON_TRY(const stage::Stage stage, open(selections));
    TENON_TRY(layer::Layer content, content_of(stage, &moved));
    report(stage);  // values find further layers
    return content;
  }

 private:
  void report(const stage::Stage& stage) {
    for (const Diagnostic& finding : stage.diagnostics()) {
      if (known_.insert(finding.to_string()).second) {
        diagnostics_.add(finding);
      }
    }
  }

  const AssetSource& source_;
  stage::WorkAccount work_;
  Diagnostics& diagnostics_;
  std::set<std::string> known_;
};

/// The selected view, else that of the strongest engine.
std::size_t choose(const SourceViews& views) {
  std::vector<std::string_view> names{views.selection};
  const auto known = known_physics_variants();
  names.insert(names.end(), known.begin(), known.end());
  for (const std::string_view name : names) {
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
              "\" is not on the default prim: its selection stays, the other variants are removed");
      lost.fix = "move the variant set to the default prim";
      diagnostics.add(std::move(lost));
    }
    if (!prim.is_instance()) {
      const std::vector<stage::Prim> children = prim.children();
      pending.insert(pending.end(), children.rbegin(), children.rend());
    }
  }
}

Token field_of_targets(const layer::Spec& spec) {
  return spec.kind == layer::SpecKind::Relationship ? layer::fields::targetPaths
                                                    : layer::fields::connectionPaths;
}

/// Nothing outside the default prim is left that a target could name, and references to an asset
/// drop such targets. The root means everything.
void drop_targets_outside(layer::Layer& content, Path robot, std::set<Path>& said,
                          Diagnostics& diagnostics) {
  for (const Path& prim : prims_below(content)) {
    for (const Path& property : properties_of(content, prim)) {
      layer::Spec& spec = *content.find(property);
      std::vector<Path> targets = targets_of(spec);
      const std::size_t count = targets.size();
      std::replace(targets.begin(), targets.end(), Path::absolute_root(), robot);
      Path dropped;
      std::erase_if(targets, [&](Path target) {
        const bool outside = !target.has_prefix(robot);
        dropped = outside ? target : dropped;
        return outside;
      });
      if (targets != targets_of(spec)) {
        targets.empty() ? spec.erase(field_of_targets(spec)) : set_targets(spec, targets);
      }
      if (targets.size() != count && said.insert(property).second) {
        diagnostics.add({Severity::Warning, "structure.target-outside",
                         "a target names " + named(dropped, RelatedRole::Target) +
                             ", which does not exist; it is skipped",
                         prim.str(), property.name().str(), "name a prim of the asset"});
      }
    }
  }
}

struct Variants {
  std::vector<std::string> physics;
  std::vector<std::pair<std::string, std::string>> others;
  Selections none;  ///< no variant of any set
};

Result<Variants> read_variants(const AssetSource& source, Composer& composer, SourceViews& views,
                               Diagnostics& diagnostics) {
  TENON_TRY(const stage::Stage stage, composer.open({}));
  const stage::Prim robot = stage.default_prim();
  if (!robot || !robot.is_defined()) {  // the selections above name it, too
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
  Composer composer(source, diagnostics);
  TENON_TRY(const Variants variants, read_variants(source, composer, views, diagnostics));
  const bool plain = variants.physics.empty();
  const Path robot = Path::absolute_root().child(views.robot);
  std::set<Path> said;
  for (const std::string& variant :
       plain ? std::vector<std::string>{std::string()} : variants.physics) {
    Selections selections = variants.none;
    if (!plain) {
      selections[std::string(kPhysicsSet)] = variant;
    }
    TENON_TRY(layer::Layer content, composer.content(selections, views.moved));
    drop_targets_outside(content, robot, said, diagnostics);
    views.physics.push_back({variant, std::move(content)});
  }
  views.chosen = choose(views);
  for (const auto& [set, variant] : variants.others) {
    Selections selections = variants.none;
    selections[set] = variant;
    if (!plain) {
      selections[std::string(kPhysicsSet)] = views.physics[views.chosen].variant;
    }
    TENON_TRY(layer::Layer content, composer.content(selections, views.moved));
    drop_targets_outside(content, robot, said, diagnostics);
    views.others.push_back({set, variant, std::move(content)});
  }
  return views;
}

std::map<Path, Path> first_places(const std::map<Path, Path>& moves) {
  std::map<Path, Path> places;
  for (const auto& [from, to] : moves) {
    places.emplace(to, from);
  }
  return places;
}

Path first_place(Path prim, const std::map<Path, Path>& places) {
  for (Path at = prim; !at.empty() && !at.is_absolute_root(); at = at.parent()) {
    if (const auto found = places.find(at); found != places.end()) {
      return prim.replace_prefix(at, found->second);
    }
  }
  return prim;
}

}  // namespace tenon::structure
