// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/stage_walk.h"

#include <utility>

#include "tenon/physics/physics_tokens.h"
#include "tenon/physics/stray_properties.h"
#include "tenon/stage/transform_at.h"

namespace tenon::physics {
namespace {

/// What a prim hands down to its children.
struct Inherited {
  Mat4d world = Mat4d::identity();
  std::uint32_t body = kNone;
  std::uint32_t mass = kNone;
  std::uint32_t articulation_root = kNone;
  bool resets_below_body = false;
  bool collides = false;  ///< the collision API of a prim above means its shapes (S-47)
};

struct Pending {
  stage::Prim prim;
  Inherited above;
};

class Walker {
 public:
  Walker(const AttributeValues& values, const Readings& readings, Walk& walk)
      : values_(values), readings_(readings), walk_(walk) {}

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

  Roles collision_from_above(Roles roles, Inherited& state) const {
    if (readings_.collision_on_group == CollisionOnGroup::ShapesBelow) {
      const bool shape = roles.kind >= PrimKind::Cube && roles.kind < PrimKind::OtherGprim;
      if (shape && state.collides) {
        roles.apis |= std::uint64_t{1} << static_cast<unsigned>(Api::Collision);
      }
      state.collides = state.collides || (roles.has(Api::Collision) && !shape);
    }
    return roles;
  }

  void visit(const stage::Prim& prim, Inherited state) {
    const Roles roles = collision_from_above(finder_.roles_of(prim), state);
    bool resets = false;
    if (roles.xformable) {
      const stage::LocalTransform local = stage::local_transform(prim, values_.start());
      resets = local.resets_stack;
      state.world = resets ? local.matrix : local.matrix * state.world;
    }
    state.resets_below_body = state.resets_below_body || resets;
    if (!is_joint(roles.kind)) {
      report_stray_properties(values_, prim, roles);
    }
    if (roles.matters()) {
      add(prim, roles, state);
    }
    // S-38: prototypes are not simulated where they stand.
    if (roles.kind != PrimKind::PointInstancer) {
      push_children(prim, state);
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
    const bool enabled = roles.has(Api::RigidBody) && is_enabled_body(prim, roles);
    if (enabled && stands_alone(prim, state)) {
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
    // S-28: a body that is enabled at some time is one throughout.
    const stage::Attribute enabled = prim.attribute(physics_tokens().body_enabled);
    const bool later = values_.stage_is_animated() && enabled.is_animated();
    return values_.flag(prim, physics_tokens().body_enabled, true) || later;
  }

  /// S-24: whether a body below another is one of its own.
  bool stands_alone(const stage::Prim& prim, const Inherited& above) const {
    if (readings_.nesting == Nesting::Independent || above.body == kNone) {
      return true;
    }
    if (readings_.nesting == Nesting::Error) {
      if (above.resets_below_body) {
        return true;
      }
      report(values_.diagnostics(), prim, Severity::Error, "body.nested-rejected",
             "the body lies below another one; it is part of that",
             "author !resetXformStack! on it, or place it beside the other");
      return false;
    }
    report(values_.diagnostics(), prim, Severity::Warning, "body.nested-ignored",
           "the body lies below another one; it is part of that", "place it beside the other body");
    return false;
  }

  const AttributeValues& values_;
  const Readings& readings_;
  Walk& walk_;
  RoleFinder finder_;
  std::vector<Pending> pending_;
};

}  // namespace

Walk walk_stage(const stage::Stage& stage, const AttributeValues& values,
                const Readings& readings) {
  Walk walk;
  Walker(values, readings, walk).run(stage.pseudo_root());
  return walk;
}

}  // namespace tenon::physics
