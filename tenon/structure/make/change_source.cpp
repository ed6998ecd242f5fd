// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/structure/make/change_source.h"

#include <string>
#include <utility>
#include <vector>

#include "tenon/structure/layer_tree.h"
#include "tenon/structure/make/default_material.h"
#include "tenon/structure/make/one_mesh.h"
#include "tenon/structure/make/schema_generation.h"
#include "tenon/structure/make/sleeping_colliders.h"
#include "tenon/structure/proof/proof.h"

namespace tenon::structure {

using layer::Layer;

Result<void> change_generation(SourceViews& views, SchemaGeneration generation,
                               const ContentPhysics& physics, Diagnostics& diagnostics) {
  if (generation == SchemaGeneration::AsAuthored) {
    return {};
  }
  const std::vector<SourceView> before = views.physics;
  const std::set<std::string> widened = use_generation(views, generation, diagnostics);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const SourceView& after = views.physics[i];
    if (widened.contains(after.variant)) {
      continue;
    }
    TENON_TRY(const scene::PhysicsScene was, physics.of(before[i].content));
    TENON_TRY(const scene::PhysicsScene is, physics.of(after.content));
    if (const auto where = compare_physics(was, is, [](Path path) { return path; })) {
      return differs("Physics=" + after.variant, *where, "the physics in other schemas");
    }
  }
  return {};
}

Result<std::map<Path, Path>> change_for_simready(SourceViews& views,
                                                 const ContentPhysics& physics) {
  TENON_TRY(auto united, unite_coincident_meshes(views, physics));
  for (SourceView& view : views.physics) {
    draw_by_meshes(view.content);
    bind_default_material(view.content);
  }
  for (OtherVariant& other : views.others) {
    draw_by_meshes(other.content);
    bind_default_material(other.content);
  }
  return united;
}

namespace {

Result<void> move_in(const LinkMoves& moves, const std::string& variant,
                     const ContentPhysics& physics, Layer& content) {
  TENON_TRY(const stage::Stage before, physics.stage_of(content));
  Layer result = moves.apply(content, before);
  TENON_TRY(const stage::Stage after, physics.stage_of(result));
  if (const auto where = moves.compare(content, before, after)) {
    return differs(variant, *where, "the scene with its links moved");
  }
  content = std::move(result);
  return {};
}

}  // namespace

Result<std::optional<LinkMoves>> move_links(SourceViews& views, LinkNesting nesting,
                                            const ContentPhysics& physics,
                                            Diagnostics& diagnostics) {
  std::optional<LinkMoves> moves;
  if (nesting == LinkNesting::AsAuthored) {
    return moves;
  }
  std::vector<const Layer*> contents;
  for (const SourceView& view : views.physics) {
    contents.push_back(&view.content);
  }
  const Layer united = unite(contents);
  TENON_TRY(const scene::PhysicsScene scene, physics.of(united));
  moves.emplace(united, scene, nesting, diagnostics);
  if (moves->empty()) {
    return moves;
  }
  for (SourceView& view : views.physics) {
    TENON_CHECK(move_in(*moves, "Physics=" + view.variant, physics, view.content));
  }
  for (OtherVariant& other : views.others) {
    TENON_CHECK(move_in(*moves, other.set + "=" + other.variant, physics, other.content));
  }
  return moves;
}

}  // namespace tenon::structure
