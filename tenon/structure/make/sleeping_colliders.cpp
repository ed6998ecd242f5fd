// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// All variants share one base, so a mesh or a collider that only some of them use is switched off
// there: it sleeps, and the layer of a variant wakes it. The base takes what a sleeping prim is
// from the first view that has it awake, without physics unless it is a collider. Views are united
// for decisions that have to be the same in all of them: a prim is taken from the first view in
// which it is awake, with the API schemas of all. Order among siblings is kept throughout.
#include "tenon/structure/make/sleeping_colliders.h"

#include <algorithm>
#include <optional>

#include "tenon/layer/fields.h"
#include "tenon/schema/registry.h"
#include "tenon/structure/layer_tree.h"
#include "tenon/structure/make/mesh_wrappers.h"
#include "tenon/structure/proof/content.h"

namespace tenon::structure {
namespace {

namespace fields = layer::fields;
using layer::Layer;

Token token_of(const Layer& content, Path property) {
  const layer::Spec* spec = content.find(property);
  return spec == nullptr ? Token() : spec->get_or(fields::default_value, Token());
}

bool is_hidden(const Layer& content, Path prim) {
  for (Path at = prim; at.is_prim(); at = at.parent()) {
    const Token purpose = token_of(content, at.property("purpose"));
    if (token_of(content, at.property("visibility")) == "invisible") {
      return true;
    }
    if (!purpose.empty()) {
      return purpose == "guide";
    }
  }
  return false;
}

bool has_only_materials(const Layer& content, Path prim, Path besides) {
  const std::vector<Path> children = child_prims(content, prim);
  return std::all_of(children.begin(), children.end(), [&](Path child) {
    return child == besides || type_of(content, child) == "GeomSubset" ||
           holds_materials(content, child);
  });
}

bool holds_mesh(const Layer& content, Path prim) {
  const std::vector<Path> below = prims_below(content, prim);
  return std::any_of(below.begin(), below.end(),
                     [&](Path path) { return type_of(content, path) == "Mesh"; });
}

/// Takes out what a prim says and all below it; it stays in its place among its siblings.
void empty_prim(Layer& layer, Path prim) {
  for (const Path& path : prims_below(layer, prim)) {
    for (const Path& property : properties_of(layer, path)) {
      layer.erase(property);
    }
    if (path != prim) {
      layer.erase(path);
    }
  }
  layer.find(prim)->set_field_list({});
}

bool is_bare(const Layer& content, Path prim) {
  return child_prims(content, prim).empty() && properties_of(content, prim).empty();
}

}  // namespace

std::set<Path> pure_colliders(const Layer& content) {
  std::set<Path> found;
  for (const Path& prim : prims_below(content)) {
    const Token type = type_of(content, prim);
    if (!has_api(content, prim, "PhysicsCollisionAPI") || !is_hidden(content, prim) ||
        has_api(content, prim, "PhysicsRigidBodyAPI") ||
        !schema::Registry::instance().is_a(type, "Gprim")) {
      continue;
    }
    const Path place = type == "Mesh" ? prim.parent() : prim;
    if (has_only_materials(content, place, prim) && has_only_materials(content, prim, Path())) {
      found.insert(place);
    }
  }
  return found;
}

Layer unite(const std::vector<const Layer*>& views) {
  Layer united = views.empty() ? Layer("anon:united.usda") : *views.front();
  for (const Layer* view : views) {
    for (const Path& prim : prims_below(*view)) {
      const bool sleeps = united.has(prim) && !is_active(united, prim) && is_active(*view, prim);
      if (sleeps) {
        remove_tree(united, prim);
      }
      if (!united.has(prim)) {
        copy_tree(*view, prim, united, prim);
        place_child_like(united, prim, *view);
        continue;
      }
      std::vector<Token> apis = apis_of(united, prim);
      for (const Token api : apis_of(*view, prim)) {
        if (std::find(apis.begin(), apis.end(), api) == apis.end()) {
          apis.push_back(api);
        }
      }
      set_apis(make_prim(united, prim), std::move(apis));
    }
  }
  return united;
}

void put_to_sleep(Layer& content, const std::set<Path>& prims) {
  for (const Path& prim : prims) {
    if (!content.has(prim)) {
      continue;
    }
    const Token type = type_of(content, prim);
    empty_prim(content, prim);
    define_prim(content, prim, type).set(fields::active, false);
  }
}

void fill_sleeping(Layer& base, const Layer& view, const std::set<Path>& colliders) {
  std::optional<Layer> without_physics;  // rarely needed
  for (const Path& prim : prims_below(view)) {
    if (!is_active(view, prim)) {
      continue;
    }
    const bool sleeps = base.has(prim);
    if (sleeps) {
      if (is_active(base, prim) || !is_bare(base, prim)) {
        continue;
      }
    } else if (!base.has(prim.parent()) || !holds_mesh(view, prim)) {
      continue;
    }
    if (!without_physics && !colliders.contains(prim)) {
      keep_roles(without_physics.emplace(view), RoleSet());
    }
    const Layer& from = colliders.contains(prim) ? view : *without_physics;
    if (!from.has(prim)) {
      if (sleeps) {
        remove_tree(base, prim);
      }
      continue;
    }
    if (sleeps) {
      empty_prim(base, prim);
    }
    copy_tree(from, prim, base, prim);
    make_prim(base, prim).set(fields::active, false);
    if (!sleeps) {
      place_child_like(base, prim, view);
    }
  }
}

void add_sleeping(Layer& content, const Layer& base) {
  for (const Path& prim : prims_below(base)) {
    if (is_active(base, prim) || !content.has(prim.parent())) {
      continue;
    }
    if (content.has(prim) && (is_active(content, prim) || !is_bare(content, prim))) {
      continue;
    }
    if (content.has(prim)) {
      remove_tree(content, prim);
    }
    copy_tree(base, prim, content, prim);
  }
}

}  // namespace tenon::structure
