// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/stage_walk.h"

#include <utility>

#include "tenon/physics/physics_tokens.h"
#include "tenon/stage/transform_at.h"

namespace tenon::physics {
namespace {

/// Properties that count only where their API is applied (S-2).
struct ApiProperty {
  Token name;
  Api api;
  const char* api_name;
};

const std::vector<ApiProperty>& api_properties() {
  static const std::vector<ApiProperty> list{
      {"physics:rigidBodyEnabled", Api::RigidBody, "PhysicsRigidBodyAPI"},
      {"physics:kinematicEnabled", Api::RigidBody, "PhysicsRigidBodyAPI"},
      {"physics:velocity", Api::RigidBody, "PhysicsRigidBodyAPI"},
      {"physics:mass", Api::Mass, "PhysicsMassAPI"},
      {"physics:filteredPairs", Api::FilteredPairs, "PhysicsFilteredPairsAPI"},
      {"physics:dynamicFriction", Api::Material, "PhysicsMaterialAPI"}};
  return list;
}

/// What a prim hands down to its children.
struct Inherited {
  Mat4d world = Mat4d::identity();
  std::uint32_t body = kNone;
  std::uint32_t mass = kNone;
  std::uint32_t articulation_root = kNone;
  bool resets_below_body = false;
};

struct Pending {
  stage::Prim prim;
  Inherited above;
};

class Walker {
 public:
  Walker(const AttributeValues& values, Walk& walk) : values_(values), walk_(walk) {}

  void run(const stage::Prim& root) {
    push_children(root, {});
    while (!pending_.empty()) {
      Pending next = std::move(pending_.back());
      pending_.pop_back();
      visit(next.prim, std::move(next.above));
    }
  }

 private:
  // S-1
  static bool counts(const stage::Prim& prim) {
    return prim.is_active() && prim.is_defined() && !prim.is_abstract() && prim.is_loaded();
  }

  void push_children(const stage::Prim& prim, const Inherited& state) {
    const std::vector<stage::Prim> children = prim.children();
    for (std::size_t i = children.size(); i > 0; --i) {
      if (counts(children[i - 1])) {
        pending_.push_back({children[i - 1], state});
      }
    }
  }

  void visit(const stage::Prim& prim, Inherited state) {
    const Roles& roles = finder_.roles_of(prim);
    bool resets = false;
    if (roles.xformable) {
      const stage::LocalTransform local = stage::local_transform(prim, values_.start());
      resets = local.resets_stack;
      state.world = resets ? local.matrix : local.matrix * state.world;
    }
    state.resets_below_body = state.resets_below_body || resets;
    if (!is_joint(roles.kind)) {
      report_strays(prim, roles);
    }
    if (roles.matters()) {
      add(prim, roles, state);
    }
    // S-38: prototypes are not simulated where they stand.
    if (roles.kind != PrimKind::PointInstancer) {
      push_children(prim, state);
    }
  }

  /// What looks like physics and is none: properties without their API, types of older texts.
  void report_strays(const stage::Prim& prim, const Roles& roles) const {
    for (const ApiProperty& row : api_properties()) {
      if (!roles.has(row.api) && prim.has_property(row.name)) {
        values_.report(prim, row.name, Severity::Warning, "attribute.api-missing",
                       row.name.str() + " is ignored: " + row.api_name + " is not applied",
                       std::string("apply ") + row.api_name);
      }
    }
    if (!roles.meant_type.empty()) {
      report(values_.diagnostics(), prim, Severity::Warning, "joint.unknown-type",
             "there is no type \"" + prim.type_name().str() + "\"; the joint is left out",
             "write " + roles.meant_type.str());
    }
  }

  void add(const stage::Prim& prim, const Roles& roles, Inherited& state) {
    const auto index = static_cast<std::uint32_t>(walk_.prims.size());
    PhysicsPrim found;
    found.prim = prim;
    found.path = prim.path();
    found.roles = roles;
    found.world = state.world;
    found.resets_below_body = state.resets_below_body;
    if (roles.has(Api::RigidBody) && is_enabled_body(prim, roles)) {
      found.is_body = true;
      found.outer_body = state.body;
      state.body = index;
      state.mass = kNone;
      state.resets_below_body = false;
    }
    found.body = state.body;
    found.mass_above = state.mass;
    // S-26: the mass of a disabled body does not count.
    if (roles.has(Api::Mass) && (found.is_body || !roles.has(Api::RigidBody))) {
      state.mass = index;
    }
    found.mass = state.mass;
    found.articulation_root = state.articulation_root;
    if (roles.has(Api::ArticulationRoot)) {
      state.articulation_root = index;
    }
    walk_.index_of.emplace(found.path, index);
    walk_.prims.push_back(std::move(found));
  }

  bool is_enabled_body(const stage::Prim& prim, const Roles& roles) const {
    if (!roles.xformable) {
      // S-22
      report(values_.diagnostics(), prim, Severity::Error, "body.not-xformable",
             "PhysicsRigidBodyAPI is applied to a prim of type \"" + prim.type_name().str() +
                 "\" that has no transform; it is no body",
             "apply it to an Xform or a shape");
      return false;
    }
    return values_.flag(prim, physics_tokens().body_enabled, true);
  }

  const AttributeValues& values_;
  Walk& walk_;
  RoleFinder finder_;
  std::vector<Pending> pending_;
};

}  // namespace

Walk walk_stage(const stage::Stage& stage, const AttributeValues& values) {
  Walk walk;
  Walker(values, walk).run(stage.pseudo_root());
  return walk;
}

}  // namespace tenon::physics
