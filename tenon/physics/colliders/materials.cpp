// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Materials are read before colliders and bound after them. A binding is resolved for the purpose
// "physics" by the rules of UsdShade, and one that wins without physics means no physics material
// (S-67, S-68). Materials of faces come last: a subset is kept where its material differs from that
// of its mesh. Values that no engine can use are replaced and reported (S-73). Lengths are
// converted to SI.
#include <algorithm>
#include <cmath>
#include <set>

#include "tenon/base/text/counted.h"
#include "tenon/base/text/text_number.h"
#include "tenon/physics/colliders/collider_settings.h"
#include "tenon/physics/colliders/shapes.h"
#include "tenon/physics/read_state.h"
#include "tenon/stage/collections/inherited_bindings.h"

namespace tenon::physics {
namespace {

/// A coefficient that is not negative; unauthored 0 (S-71).
double coefficient(const ReadState& state, const stage::Prim& prim, Token name) {
  const double value = state.values.number(prim, name).value_or(0);
  if (value < 0) {
    // S-73
    state.report(prim, name, Severity::Error, "material.negative",
                 name.str() + " is " + text_of_float(value) + "; 0 is used instead",
                 "author a value that is not negative");
    return 0;
  }
  return value;
}

/// S-72: what a vendor's API says of pairs.
CombineMode combine_mode(const ReadState& state, const PhysicsPrim& found, Token name) {
  if (!found.roles.has(Api::PhysxMaterial)) {
    return CombineMode::Average;
  }
  const Token mode = state.values.get<Token>(found.prim, name).value_or(Token("average"));
  for (int i = 0; i <= static_cast<int>(CombineMode::Max); ++i) {
    if (mode == combine_name(static_cast<CombineMode>(i))) {
      return static_cast<CombineMode>(i);
    }
  }
  state.report(found.prim, name, Severity::Warning, "material.combine-unknown",
               name.str() + " is \"" + mode.str() + "\"; the average is used instead",
               "use average, min, multiply or max");
  return CombineMode::Average;
}

/// What resists spinning and rolling: lengths, of Newton's schema before MuJoCo's.
void read_spin_friction(const ReadState& state, const PhysicsPrim& found, Material& material) {
  const auto take = [&](Token name, std::optional<double>& value) {
    const std::optional<double> authored = state.values.authored_number(found.prim, name);
    if (value || !authored) {
      return;
    }
    if (!(*authored >= 0) || !std::isfinite(*authored)) {
      state.report(found.prim, name, Severity::Error, "material.negative",
                   name.str() + " is " + text_of_float(*authored) + "; it is treated as unauthored",
                   "author a value that is not negative");
      return;
    }
    value = *authored * state.units.length;
  };
  if (found.roles.has(Api::NewtonMaterial) || found.roles.has(Api::MjcMaterial)) {
    take(state.tokens.newton_torsional_friction, material.torsional_friction);
    take(state.tokens.newton_rolling_friction, material.rolling_friction);
  }
  if (found.roles.has(Api::MjcMaterial)) {
    take(state.tokens.mjc_torsional_friction, material.torsional_friction);
    take(state.tokens.mjc_rolling_friction, material.rolling_friction);
  }
}

Material read_material(const ReadState& state, const PhysicsPrim& found) {
  Material material;
  material.path = found.path;
  material.static_friction = coefficient(state, found.prim, state.tokens.static_friction);
  material.dynamic_friction = coefficient(state, found.prim, state.tokens.dynamic_friction);
  material.restitution = coefficient(state, found.prim, state.tokens.restitution);
  const double density = state.values.number(found.prim, state.tokens.density).value_or(0);
  if (density > 0 && std::isfinite(density)) {
    material.density = density * state.units.density();
  }
  read_spin_friction(state, found, material);
  material.friction_combine = combine_mode(state, found, state.tokens.physx_friction_combine);
  material.restitution_combine = combine_mode(state, found, state.tokens.physx_restitution_combine);
  material.compliance = read_compliance(state, found);
  material.compliance.damping_combine =
      combine_mode(state, found, "physxMaterial:dampingCombineMode");
  // S-73
  if (material.dynamic_friction > material.static_friction) {
    state.report(found.prim, state.tokens.dynamic_friction, Severity::Warning,
                 "material.friction-order",
                 "dynamic friction " + text_of_float(material.dynamic_friction) +
                     " exceeds static friction " + text_of_float(material.static_friction) +
                     "; both become the larger one at rest",
                 "author a staticFriction that is at least dynamicFriction");
    material.static_friction = material.dynamic_friction;
  }
  if (material.restitution > 1) {
    state.report(
        found.prim, state.tokens.restitution, Severity::Warning, "material.restitution",
        "restitution " + text_of_float(material.restitution) + " adds energy; 1 is used instead",
        "author a restitution from 0 to 1");
    material.restitution = 1;
  }
  return material;
}

/// S-71: one finding where some colliders have a material and others none.
void report_unbound(const ReadState& state) {
  const std::vector<Collider>& colliders = state.scene.colliders;
  const auto is_unbound = [](const Collider& c) { return c.enabled && !c.material; };
  const auto first = std::find_if(colliders.begin(), colliders.end(), is_unbound);
  if (first == colliders.end()) {
    return;
  }
  const auto count = std::count_if(first, colliders.end(), is_unbound);
  state.report(state.prim_of_collider(static_cast<Index>(first - colliders.begin())).prim,
               Severity::Info, "material.none-bound",
               counted(static_cast<std::size_t>(count), "collider has", "colliders have") +
                   " no physics material, others do: friction " +
                   shortest(state.scene.unbound.dynamic_friction) +
                   " is used; PhysX uses 0.5, Newton and MuJoCo 1",
               "bind a physics material to every collider");
}

}  // namespace

void read_materials(ReadState& state) {
  const auto prims = sorted_prims(state.walk, [](const PhysicsPrim& p) {
    return p.roles.has(Api::Material) && !p.roles.has(Api::Collision);
  });
  for (const std::uint32_t i : prims) {
    const auto index = static_cast<Index>(state.scene.materials.size());
    state.material_of_path.emplace(state.walk.prims[i].path, index);
    state.scene.materials.push_back(read_material(state, state.walk.prims[i]));
  }
}

void bind_materials(ReadState& state) {
  if (state.scene.materials.empty()) {
    return;  // nothing that a binding could find
  }
  stage::InheritedBindings bindings(Token("physics"), state.target_memo);
  bool bound = false;
  std::set<Path> told;
  for (Index i = 0; i < state.scene.colliders.size(); ++i) {
    const PhysicsPrim& found = state.prim_of_collider(i);
    const stage::MaterialBinding binding = bindings.find(found.prim);
    if (const Path cut = binding.cut_collection; !cut.empty() && told.insert(cut).second) {
      state.not_read(state.stage.prim(cut.parent()), cut.name().str(),
                     "the collection is too large or its expression too costly (docs/limits.md); "
                     "some of its members do not get the material");
    }
    // S-67, S-68: a binding that wins and has no physics means no physics material.
    const auto material = state.material_of_path.find(binding.material);
    if (material == state.material_of_path.end()) {
      continue;
    }
    bound = true;
    state.scene.colliders[i].material = material->second;
    if (binding.binding_api_missing) {
      // S-69
      state.report(found.prim, Severity::Warning, "material.binding-api-missing",
                   named(binding.material, RelatedRole::Material) +
                       " is bound without MaterialBindingAPI applied; it counts here, not in "
                       "OpenUSD",
                   "apply MaterialBindingAPI to the prim that binds it");
    }
  }
  for (Index i = 0; i < state.scene.colliders.size(); ++i) {
    if (state.prim_of_collider(i).roles.kind == PrimKind::Mesh) {
      read_face_materials(state, i);
    }
  }
  if (bound) {
    report_unbound(state);
  }
}

}  // namespace tenon::physics
