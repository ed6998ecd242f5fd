// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Bodies are the prims that the walk marked, in the order of their paths. A body that cannot move
// (it is disabled, its transform is not finite, its owner is no scene) is kept as a kinematic one,
// so that what refers to it has an index. Velocities are authored in the space of the parent and
// converted here to world axes and SI. The scale of that space acts on the linear velocity alone,
// the angular one is only rotated. A prototype of a point instancer takes them from the arrays
// where these have some.
#include <cmath>
#include <string>

#include "tenon/base/text/counted.h"
#include "tenon/physics/read_state.h"
#include "tenon/physics/scenes.h"
#include "tenon/physics/world_pose.h"
#include "tenon/stage/transform_at.h"

namespace tenon::physics {
namespace {

/// By more than what single precision leaves of a rotation.
bool differs(const Vec3d& a, const Vec3d& b) {
  return length(a - b) > 1e-5 * (length(a) + length(b));
}

/// The array entry that gives the body its velocity: of the prototypes of point instancers (S-38).
const ArrayInstance* array_of(const ReadState& state, const PhysicsPrim& found) {
  if (found.instance == kNone) {
    return nullptr;
  }
  const PointInstance& instance = state.walk.instances[found.instance];
  const bool given = instance.array.has_velocity || instance.array.has_angular_velocity;
  return given && instance.prototype == found.prim ? &instance.array : nullptr;
}

/// The space that velocities are given in: that of the prim's transform (S-30), or by option the
/// body's own axes or the world's, which have no scale.
Mat4d velocity_space(const ReadState& state, const PhysicsPrim& found, const Body& body) {
  if (state.readings.velocity_space == VelocitySpace::Body) {
    return pose_matrix({{}, body.pose.orientation});
  }
  if (state.readings.velocity_space == VelocitySpace::World) {
    return Mat4d::identity();
  }
  if (found.instance == kNone &&
      stage::local_transform(found.prim, state.values.start()).resets_stack) {
    return Mat4d::identity();
  }
  if (const ArrayInstance* array = array_of(state, found); array != nullptr) {
    return state.walk.instances[found.instance].instancer_world;
  }
  return state.walk.world_near(found, found.prim.parent(), state.values.start());
}

/// S-118
void report_animated_velocity(const ReadState& state, const PhysicsPrim& found) {
  if (!state.values.stage_is_animated()) {
    return;
  }
  for (const Token name : {state.tokens.velocity, state.tokens.angular_velocity}) {
    if (found.prim.attribute(name).is_animated()) {
      state.report(found.prim, name, Severity::Warning, "body.velocity-animated",
                   name.str() + " is animated; it acts at the start only",
                   "author one value, or make the body kinematic and animate its transform");
      return;
    }
  }
}

/// S-30, S-31: parent space, its scale included; S-32: angular velocity is a rotation vector.
void read_velocities(const ReadState& state, const PhysicsPrim& found, Body& body) {
  report_animated_velocity(state, found);
  const Vec3d zero;
  const ArrayInstance* array = array_of(state, found);
  const Vec3d linear = array != nullptr
                           ? array->velocity
                           : state.values.vector(found.prim, state.tokens.velocity).value_or(zero);
  const Vec3d angular =
      array != nullptr
          ? array->angular_velocity
          : state.values.vector(found.prim, state.tokens.angular_velocity).value_or(zero);
  if (linear == zero && angular == zero) {
    return;
  }
  if (body.kinematic) {
    // S-27
    state.report(found.prim, state.tokens.velocity, Severity::Warning, "body.kinematic-velocity",
                 "the velocity of a kinematic body is ignored; it follows from its poses",
                 "animate its transform instead");
    return;
  }
  const Mat4d space = velocity_space(state, found, body);
  const Quatd turn = rigid_part(space).orientation;
  const double speed = state.units.length * state.units.rate;
  const Vec3d spin = angular * (kRadians * state.units.rate);
  body.linear_velocity = transform_direction(linear, space) * speed;
  body.angular_velocity = rotate(turn, spin);
  const Vec3d as_world = linear * speed;
  const bool from_world =
      differs(body.linear_velocity, as_world) || differs(body.angular_velocity, spin);
  const bool from_body = differs(as_world, rotate(body.pose.orientation, as_world)) ||
                         differs(spin, rotate(body.pose.orientation, spin));
  if (array == nullptr && (from_world || from_body)) {  // those of arrays have one meaning
    state.report(found.prim, linear == zero ? state.tokens.angular_velocity : state.tokens.velocity,
                 Severity::Warning, "body.velocity-space",
                 std::string("velocities are read in the space of the parent; engines that take ") +
                     (from_world ? "world or body" : "body") + " axes start this body differently",
                 "leave the prim and its ancestors unrotated and unscaled, or check the result");
  }
}

void check_frame(const ReadState& state, const PhysicsPrim& found, const Factored& parts) {
  if (parts.sheared) {
    // S-33
    state.report(found.prim, Severity::Warning, "body.sheared",
                 "the body is sheared by a rotation under a non-uniform scale; its colliders are "
                 "placed exactly, its frame is the nearest rotation",
                 "remove the non-uniform scale above the body");
  }
  if (parts.scale[0] == 0 || parts.scale[1] == 0 || parts.scale[2] == 0) {
    state.report(found.prim, Severity::Error, "body.zero-scale",
                 "the body is scaled to zero along an axis", "author a scale that is not zero");
  }
}

/// S-123
void check_instance(const ReadState& state, const PhysicsPrim& found) {
  if (found.prim.is_instance_proxy()) {
    state.report(found.prim, Severity::Warning, "body.in-instance",
                 "the body is inside an instance: it is simulated, its motion cannot be written "
                 "to it",
                 "apply PhysicsRigidBodyAPI to the instance itself, or make it not instanceable");
  }
}

void read_motion_settings(const ReadState& state, const PhysicsPrim& found, Body& body) {
  const AttributeValues& values = state.values;
  body.gravity_scale =
      values.authored_number(found.prim, state.tokens.gravity_scale).value_or(body.gravity_scale);
  if (!found.roles.has(Api::PhysxRigidBody)) {
    return;
  }
  body.linear_damping =
      values.authored_number(found.prim, state.tokens.physx_linear_damping).value_or(0);
  body.angular_damping =
      values.authored_number(found.prim, state.tokens.physx_angular_damping).value_or(0);
  if (values.authored_flag(found.prim, state.tokens.physx_disable_gravity).value_or(false)) {
    body.gravity_scale = 0;
  }
}

Body read_body(ReadState& state, const PhysicsPrim& found, Index scene) {
  Body body;
  body.path = found.path;
  if (found.instance != kNone) {
    const PointInstance& instance = state.walk.instances[found.instance];
    body.instance = InstanceSource{instance.instancer.path(),
                                   instance.prototype.path(),
                                   found.prim.path(),
                                   instance.array.index,
                                   found.world,
                                   instance.outer != kNone};
  }
  body.kinematic = state.values.flag(found.prim, state.tokens.kinematic, false);
  body.enabled = state.values.flag(found.prim, state.tokens.body_enabled, true);
  body.kinematic = body.kinematic || !body.enabled;
  body.starts_asleep = state.values.flag(found.prim, state.tokens.starts_asleep, false);
  const Factored parts = factor(found.world);
  body.pose = world_pose(parts, state.units);
  state.body_has_place.push_back(is_finite(body.pose));
  if (!state.body_has_place.back()) {
    state.report(found.prim, Severity::Error, "body.not-finite",
                 "the body's transform is not made of finite numbers; it is fixed at the origin",
                 "author finite transforms");
    body.pose = {};
    body.kinematic = true;
  }
  check_frame(state, found, parts);
  check_instance(state, found);
  const OwnerScene owner = owner_scene(state, found.prim, scene);
  body.scene = owner.scene;
  if (!owner.found) {
    body.kinematic = true;  // stands still (S-19)
  }
  read_velocities(state, found, body);
  read_motion_settings(state, found, body);
  return body;
}

/// Nested bodies are bodies of their own (S-24); one finding per outermost body. Links of a robot
/// are nested on purpose, as Isaac Sim's importers write them.
void report_nesting(const ReadState& state) {
  std::vector<std::uint32_t> nested(state.walk.prims.size(), 0);
  std::vector<bool> all_links(state.walk.prims.size(), true);
  for (const PhysicsPrim& found : state.walk.prims) {
    if (!found.is_body || found.outer_body == kNone || found.resets_below_body) {
      continue;
    }
    std::uint32_t outermost = found.outer_body;
    while (state.walk.prims[outermost].outer_body != kNone) {
      outermost = state.walk.prims[outermost].outer_body;
    }
    ++nested[outermost];
    all_links[outermost] = all_links[outermost] && found.prim.has_api("IsaacLinkAPI");
  }
  for (std::size_t i = 0; i < nested.size(); ++i) {
    if (nested[i] > 0) {
      state.report(state.walk.prims[i].prim, all_links[i] ? Severity::Info : Severity::Warning,
                   "body.nested",
                   counted(nested[i], "rigid body is nested", "rigid bodies are nested") +
                       " below this one; each moves on its own",
                   "author !resetXformStack! on them, or place them beside each other, for engines "
                   "that reject nested bodies");
    }
  }
}

}  // namespace

void read_bodies(ReadState& state) {
  state.body_prims = sorted_prims(state.walk, [](const PhysicsPrim& p) { return p.is_body; });
  state.body_of_prim.assign(state.walk.prims.size(), kNone);
  state.scene.bodies.reserve(state.body_prims.size());
  const Index scene = default_scene(state);
  for (const std::uint32_t i : state.body_prims) {
    state.body_of_prim[i] = static_cast<std::uint32_t>(state.scene.bodies.size());
    state.scene.bodies.push_back(read_body(state, state.walk.prims[i], scene));
  }
  state.colliders_of_body.resize(state.scene.bodies.size());
  report_nesting(state);
}

}  // namespace tenon::physics
