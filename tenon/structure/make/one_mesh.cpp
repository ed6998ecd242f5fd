// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Pairs are looked for among the children of one prim, where the same operations put the same
// points to the same place. A pair of one view is one of all, so that none keeps a prim which the
// others have not.
#include "tenon/structure/make/one_mesh.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "tenon/layer/fields.h"
#include "tenon/layer/spec_equality.h"
#include "tenon/structure/layer_tree.h"
#include "tenon/structure/make/mesh_wrappers.h"
#include "tenon/structure/proof/proof.h"

namespace tenon::structure {
namespace {

namespace fields = layer::fields;
using layer::Layer;
using layer::Spec;

Token token_value(const Layer& content, Path prim, const char* name) {
  const Spec* spec = content.find(prim.property(Token(name)));
  return spec == nullptr ? Token() : spec->get_or(fields::default_value, Token());
}

bool collides(const Layer& content, Path prim) {
  return has_api(content, prim, "PhysicsCollisionAPI");
}

bool is_visible(const Layer& content, Path prim) {
  const Token purpose = token_value(content, prim, "purpose");
  return (purpose.empty() || purpose == "default" || purpose == "render") &&
         token_value(content, prim, "visibility") != "invisible";
}

bool is_hidden_collider(const Layer& content, Path prim) {
  return collides(content, prim) && token_value(content, prim, "purpose") == "guide" &&
         !has_api(content, prim, "PhysicsRigidBodyAPI") && child_prims(content, prim).empty();
}

std::vector<Path> transforms_of(const Layer& content, Path prim) {
  std::vector<Path> found;
  for (const Path& property : properties_of(content, prim)) {
    if (is_transform(property.name())) {
      found.push_back(property);
    }
  }
  return found;
}

bool same_transforms(const Layer& content, Path one, Path other) {
  const std::vector<Path> ones = transforms_of(content, one);
  return ones.size() == transforms_of(content, other).size() &&
         std::all_of(ones.begin(), ones.end(), [&](Path property) {
           const Spec* same = content.find(other.property(property.name()));
           return same != nullptr && layer::same_spec(*content.find(property), *same);
         });
}

/// A mesh, and what it stands on its link with: itself, or a prim around it and its materials.
struct PlacedMesh {
  Path top;
  Path mesh;
};

/// The meshes of a child of a link: itself, or those right below a prim that holds nothing else but
/// materials.
std::vector<PlacedMesh> placed_meshes(const Layer& content, Path child) {
  std::vector<PlacedMesh> placed;
  if (!is_active(content, child) || has_api(content, child, "PhysicsRigidBodyAPI")) {
    return placed;
  }
  if (type_of(content, child) == "Mesh") {
    placed.push_back({child, child});
    return placed;
  }
  for (const Path& below : child_prims(content, child)) {
    if (type_of(content, below) == "Mesh" && is_active(content, below)) {
      placed.push_back({child, below});
    } else if (!holds_materials(content, below)) {
      return {};
    }
  }
  return placed;
}

/// The same points and faces: a collider has no need of the rest.
bool same_shape(const Layer& content, Path one, Path other) {
  const char* const names[] = {"faceVertexCounts", "faceVertexIndices", "points"};
  return std::all_of(std::begin(names), std::end(names), [&](const char* name) {
    const Spec* a = content.find(one.property(Token(name)));
    const Spec* b = content.find(other.property(Token(name)));
    const bool fixed = a != nullptr && b != nullptr && !a->has(fields::timeSamples) &&
                       !b->has(fields::timeSamples) && a->has(fields::default_value) &&
                       b->has(fields::default_value);
    return fixed && *a->find(fields::default_value) == *b->find(fields::default_value);
  });
}

bool same_place(const Layer& content, const PlacedMesh& one, const PlacedMesh& other) {
  return (one.top == one.mesh) == (other.top == other.mesh) &&
         same_transforms(content, one.top, other.top) &&
         same_transforms(content, one.mesh, other.mesh);
}

struct Pair {
  PlacedMesh collider;
  PlacedMesh drawn;
};
using Pairs = std::map<Path, Pair>;  // by the collider's mesh

/// Colliders of a prim's children with what is drawn in their place.
void find_pairs(const Layer& content, Path parent, Pairs& pairs) {
  std::vector<PlacedMesh> drawn;
  std::vector<PlacedMesh> hidden;
  for (const Path& child : child_prims(content, parent)) {
    for (const PlacedMesh& placed : placed_meshes(content, child)) {
      if (is_hidden_collider(content, placed.mesh)) {
        hidden.push_back(placed);
      } else if (!collides(content, placed.mesh) && is_visible(content, placed.mesh) &&
                 is_visible(content, child)) {
        drawn.push_back(placed);
      }
    }
  }
  std::set<Path> taken;
  for (const PlacedMesh& collider : hidden) {
    const auto found = std::find_if(drawn.begin(), drawn.end(), [&](const PlacedMesh& mesh) {
      return !taken.contains(mesh.mesh) && same_place(content, collider, mesh) &&
             same_shape(content, collider.mesh, mesh.mesh);
    });
    if (found != drawn.end() && pairs.emplace(collider.mesh, Pair{collider, *found}).second) {
      taken.insert(found->mesh);
    }
  }
}

/// What makes a mesh collide.
bool is_of_collider(Token property) {
  const Ownership owner = owner_of_property(property, "Mesh", {});
  return owner.owner == Role::Physics || is_engine(owner.owner);
}

/// The material of a collider, beside the drawn mesh.
Path bring_material(Layer& content, Path material, const Pair& pair) {
  if (!material.has_prefix(pair.collider.top) || pair.collider.top == pair.collider.mesh ||
      !content.has(material)) {
    return material;
  }
  const Path scope = pair.drawn.top.child(material.parent().name());
  if (!content.has(scope)) {
    define_prim(content, scope, "Scope");
  }
  const Path to =
      free_child(scope, material.name().str(), [&](Path path) { return content.has(path); });
  copy_tree(content, material, content, to);
  return to;
}

void move_collider(Layer& content, const Pair& pair) {
  const Path to = pair.drawn.mesh;
  for (const Token api : apis_of(content, pair.collider.mesh)) {
    add_api(content, to, api);
  }
  for (const Path& property : properties_of(content, pair.collider.mesh)) {
    if (is_of_collider(property.name())) {
      Spec spec = *content.find(property);
      std::vector<Path> targets = targets_of(spec);
      for (Path& target : targets) {
        target = bring_material(content, target, pair);
      }
      if (!targets.empty()) {
        set_targets(spec, std::move(targets));
      }
      put_property(content, to.property(property.name()), spec);
    }
  }
}

void redirect(Layer& content, const Pairs& pairs) {
  for (const Path& prim : prims_below(content)) {
    for (const Path& property : properties_of(content, prim)) {
      Spec& spec = *content.find(property);
      std::vector<Path> targets = targets_of(spec);
      bool changed = false;
      for (Path& target : targets) {
        const auto pair = pairs.find(target);
        changed = changed || pair != pairs.end();
        target = pair == pairs.end() ? target : pair->second.drawn.mesh;
      }
      if (changed) {
        set_targets(spec, std::move(targets));
      }
    }
  }
}

void unite_pairs(Layer& content, const Pairs& pairs) {
  for (const auto& [mesh, pair] : pairs) {
    if (!content.has(pair.collider.top)) {
      continue;  // it went with another one
    }
    if (content.has(pair.drawn.mesh) && content.has(mesh) &&
        is_active(content, pair.collider.top) && is_active(content, mesh) &&
        collides(content, mesh)) {
      move_collider(content, pair);
    }
    if (content.has(mesh)) {
      remove_tree(content, mesh);
    }
    if (content.has(pair.collider.top) && placed_meshes(content, pair.collider.top).empty()) {
      remove_tree(content, pair.collider.top);
    }
  }
  redirect(content, pairs);
}

}  // namespace

Result<std::map<Path, Path>> unite_coincident_meshes(SourceViews& views,
                                                     const ContentPhysics& physics) {
  Pairs pairs;
  std::map<Path, Path> moved;
  for (const SourceView& view : views.physics) {
    for (const Path& prim : prims_below(view.content)) {
      find_pairs(view.content, prim, pairs);
    }
  }
  for (const auto& [mesh, pair] : pairs) {
    moved.emplace(mesh, pair.drawn.mesh);
  }
  if (pairs.empty()) {
    return moved;
  }
  for (SourceView& view : views.physics) {
    TENON_TRY(const scene::PhysicsScene before, physics.of(view.content));
    unite_pairs(view.content, pairs);
    TENON_TRY(const scene::PhysicsScene after, physics.of(view.content));
    const auto where = compare_physics(before, after, [&](Path path) {
      const auto to = moved.find(path);
      return to == moved.end() ? path : to->second;
    });
    if (where) {
      return differs("Physics=" + view.variant, *where, "the physics with one mesh for two");
    }
  }
  for (OtherVariant& other : views.others) {
    unite_pairs(other.content, pairs);
  }
  return moved;
}

}  // namespace tenon::structure
