// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// All below an instance is shared, so the wrapper of a mesh holds nothing else but its materials. A
// mesh without other children that is no body becomes its own wrapper: the prim turns into an Xform
// and the mesh goes one level down. A body, a parent of other prims or a prim at the top stays as
// an Xform, and wrapper and mesh go below it. Transforms stay with the old prim, so nothing moves,
// and a body keeps all that is not about shape. A mesh that moves takes the name of the first mesh
// of equal geometry, so that both are one entry later.
#include "tenon/structure/make/mesh_wrappers.h"

#include <algorithm>

#include "tenon/layer/fields.h"
#include "tenon/structure/layout.h"
#include "tenon/structure/make/geometry_keys.h"

namespace tenon::structure {
namespace {

namespace fields = layer::fields;
using layer::Layer;
using layer::Spec;

/// Of a body that is a mesh: what stays with the shape.
bool is_of_shape(const Ownership& owner) {
  return owner.owner == Role::Geometries || owner.may_be_in(Role::Instances);
}

bool has_transform(const Layer& content, Path prim) {
  const std::vector<Path> properties = properties_of(content, prim);
  return std::any_of(properties.begin(), properties.end(),
                     [](Path property) { return is_transform(property.name()); });
}

bool is_simulated(const Layer& content, Path prim) {
  const std::vector<Token> apis = apis_of(content, prim);
  return std::any_of(apis.begin(), apis.end(), [](Token api) {
    const Role owner = owner_of_api(api).owner;
    return owner == Role::Physics || owner == Role::Robot || is_engine(owner);
  });
}

bool has_only_subsets(const Layer& content, Path mesh) {
  const std::vector<Path> children = child_prims(content, mesh);
  return std::all_of(children.begin(), children.end(),
                     [&](Path child) { return type_of(content, child) == "GeomSubset"; });
}

Result<void> check_colliders(const Layer& content) {
  for (const Path& prim : prims_below(content)) {
    if (type_of(content, prim) != "Mesh" || !is_active(content, prim) ||
        has_api(content, prim, "PhysicsCollisionAPI")) {
      continue;
    }
    Path above = prim.parent();  // the nearest that is a collider or a body itself
    while (!above.is_absolute_root() && !has_api(content, above, "PhysicsCollisionAPI") &&
           !has_api(content, above, "PhysicsRigidBodyAPI")) {
      above = above.parent();
    }
    if (type_of(content, above) == "Mesh" && has_api(content, above, "PhysicsCollisionAPI") &&
        !has_api(content, prim, "PhysicsRigidBodyAPI")) {
      return Error(ErrorCode::Invalid,
                   "meshes below this one are part of its collider; in the structure each mesh "
                   "stands by itself")
          .with_rule("structure.differs")
          .with_prim(above.str())
          .with_fix("apply PhysicsCollisionAPI to each mesh that is to collide");
    }
  }
  return {};
}

/// The child of a possible wrapper (an Xform, not at the top, and no part in the simulation) beside
/// which there are materials alone; empty: there is none.
Path lone_child(const Layer& content, Path wrapper) {
  Path lone;
  if (type_of(content, wrapper) != "Xform" || wrapper.parent().is_absolute_root() ||
      is_simulated(content, wrapper)) {
    return lone;
  }
  for (const Path& child : child_prims(content, wrapper)) {
    if (!holds_materials(content, child)) {
      if (!lone.empty()) {
        return {};
      }
      lone = child;
    }
  }
  return lone;
}

/// The mesh, alone below its parent, can stay there.
bool fits_wrapper(const Layer& content, Path mesh) {
  return !has_transform(content, mesh) && has_only_subsets(content, mesh) &&
         !has_api(content, mesh, "PhysicsRigidBodyAPI");
}

}  // namespace

bool holds_materials(const Layer& content, Path prim) {
  const Token type = type_of(content, prim);
  if (type == "Material") {
    return true;
  }
  const std::vector<Path> children = child_prims(content, prim);
  return type == "Scope" && !children.empty() &&
         std::all_of(children.begin(), children.end(),
                     [&](Path child) { return type_of(content, child) == "Material"; });
}

void copy_geometry(const Layer& content, Path mesh, Layer& target, Path to) {
  for (const Path& path : prims_below(content, mesh)) {
    const Path copy = path.replace_prefix(mesh, to);
    const Token type = type_of(content, path);
    Spec& prim = define_prim(target, copy, type);
    if (path == mesh) {
      prim.set(fields::specifier, layer::Specifier::Def);
    }
    std::vector<Path> properties = properties_of(content, path);
    std::sort(properties.begin(), properties.end());
    for (const Path& property : properties) {
      const Spec& spec = *content.find(property);
      const bool own = owner_of_property(property.name(), type, {}).owner == Role::Geometries;
      if (own && spec.kind == layer::SpecKind::Attribute) {
        put_property(target, copy.property(property.name()), spec);
      }
    }
  }
}

Result<MeshMoves> MeshMoves::of(const Layer& united) {
  TENON_CHECK(check_colliders(united));
  MeshMoves moves;
  GeometryKeys keys;
  std::map<std::string, std::string> names;  // of geometries
  std::map<Path, Path> lone;                 // children, by their parents
  for (const Path& prim : prims_below(united)) {
    if (type_of(united, prim) != "Mesh") {
      continue;
    }
    const auto known = names.emplace(keys.key(united, prim), prim.name().str());
    const auto [child, first] = lone.try_emplace(prim.parent());
    if (first) {
      child->second = lone_child(united, prim.parent());
    }
    if (child->second != prim || !fits_wrapper(united, prim)) {
      moves.add(united, prim, known.first->second);
    }
  }
  return moves;
}

void MeshMoves::add(const Layer& united, Path mesh, const std::string& name) {
  Move move;
  move.body = has_api(united, mesh, "PhysicsRigidBodyAPI");
  for (const Path& child : child_prims(united, mesh)) {
    if (type_of(united, child) == "GeomSubset") {
      move.subsets.insert(child);
    }
  }
  const bool alone = has_only_subsets(united, mesh) && !is_simulated(united, mesh);
  const bool top = mesh.parent().is_absolute_root();  // an asset is no instance of its own
  const bool bare = !top && (alone || (has_only_subsets(united, mesh) && !move.body));
  // A wrapper takes part in nothing else: not in being a body, nor a parent of other prims.
  const auto is_taken = [&](Path path) { return united.has(path); };
  move.wrapper = bare ? mesh : free_child(mesh, name, is_taken);
  move.mesh = move.wrapper == mesh ? mesh.child(Token(name)) : move.wrapper.child(Token(name));
  moves_.emplace(mesh, std::move(move));
}

std::map<Path, Path> MeshMoves::all() const {
  std::map<Path, Path> places;
  for (const auto& [from, move] : moves_) {
    places.emplace(from, move.mesh);
  }
  return places;
}

Path MeshMoves::moved(Path path) const {
  Path below;  // the child of `at` on the way
  for (Path at = path.prim(); at.is_prim(); below = at, at = at.parent()) {
    const auto found = moves_.find(at);
    if (found == moves_.end()) {
      continue;
    }
    const Move& move = found->second;
    if (move.subsets.contains(below)) {
      return path.replace_prefix(at, move.mesh);
    }
    const bool own = path.prim() == at && !(path.is_property() && is_transform(path.name()));
    return own ? path.replace_prefix(at, move.mesh) : path;
  }
  return path;
}

Path MeshMoves::moved_target(Path target) const {
  const auto found = moves_.find(target);
  return found != moves_.end() && found->second.body ? target : moved(target);
}

void MeshMoves::move_mesh(const Layer& content, Path from, const Move& move, Layer& to) const {
  Spec& place = define_prim(to, from, "Xform");
  if (!is_active(content, from)) {
    place.set(fields::active, false);
    return;
  }
  define_prim(to, move.wrapper, "Xform");
  if (const Spec* old = content.find(from)) {
    put_prim_fields(make_prim(to, move.mesh), *old);
  }
  const Token type = type_of(content, from);
  const std::vector<Token> apis = apis_of(content, from);
  const PathMap map = [this](Path path) { return moved_target(path); };
  for (const Path& property : properties_of(content, from)) {
    const bool shape = is_of_shape(owner_of_property(property.name(), type, apis));
    const bool stays = is_transform(property.name()) || (move.body && !shape);
    put_property(to, (stays ? from : move.mesh).property(property.name()), *content.find(property),
                 map);
  }
  std::vector<Token> shape_apis = apis;
  std::vector<Token> body_apis;
  if (move.body) {
    std::erase_if(shape_apis, [](Token api) { return !is_of_shape(owner_of_api(api)); });
    std::copy_if(apis.begin(), apis.end(), std::back_inserter(body_apis),
                 [](Token api) { return !is_of_shape(owner_of_api(api)); });
  }
  set_apis(make_prim(to, move.mesh), std::move(shape_apis));
  set_apis(place, std::move(body_apis));
}

Layer MeshMoves::apply(const Layer& content) const {
  if (moves_.empty()) {
    return content;
  }
  Layer result = without_prims(content, content.identifier());
  const PathMap map = [this](Path path) { return moved_target(path); };
  for (const Path& prim : prims_below(content)) {
    const auto move = moves_.find(prim);
    if (move != moves_.end()) {
      move_mesh(content, prim, move->second, result);
      continue;
    }
    const Path to = moved(prim);
    put_prim_fields(make_prim(result, to), *content.find(prim));
    for (const Path& property : properties_of(content, prim)) {
      put_property(result, to.property(property.name()), *content.find(property), map);
    }
  }
  return result;
}

}  // namespace tenon::structure
