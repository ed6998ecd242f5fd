// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What PhysX's schemas say of bodies beside UsdPhysics. Meaning and units are those of PhysX, asked
// by experiment: a force on the body's own prim acts at the centre of mass, on a prim below it at
// that prim's origin and in that prim's axes; accelerations about an axis are radians, speed limits
// degrees; axes are locked in the world.
#include <cmath>
#include <string>

#include "tenon/physics/read_state.h"
#include "tenon/physics/vendors/physx_settings.h"
#include "tenon/physics/world_pose.h"

namespace tenon::physics {
namespace {

/// PhysX's own default, for bodies on which the asset authors none.
constexpr double kPhysxAngularDamping = 0.05;  // [1/s]
constexpr double kPhysxMaxSpin = 100;          // [rad/s]

void read_force(ReadState& state, const PhysicsPrim& found) {
  const AttributeValues& values = state.values;
  if (!values.authored_flag(found.prim, "physxForce:forceEnabled").value_or(true)) {
    return;
  }
  if (found.body == kNone) {
    state.report(found.prim, Severity::Warning, "force.no-body",
                 "the force acts on nothing: neither the prim nor one above it is a rigid body",
                 "apply PhysxForceAPI to a rigid body or a prim below it",
                 api_part("PhysxForceAPI"));
    return;
  }
  Body& body = state.scene.bodies[state.body_of_prim[found.body]];
  const bool own = &state.walk.prims[found.body] == &found;
  const Token mode = values.get<Token>(found.prim, "physxForce:mode").value_or("acceleration");
  BodyForce force;
  force.source = found.path;
  force.acceleration = !(mode == "force");
  force.body_axes =
      !values.authored_flag(found.prim, "physxForce:worldFrameEnabled").value_or(false);
  const Vec3d zero;
  const Units& units = state.units;
  force.force = values.vector(found.prim, "physxForce:force").value_or(zero) *
                (force.acceleration ? units.length : units.force());
  force.torque = values.vector(found.prim, "physxForce:torque").value_or(zero) *
                 (force.acceleration ? 1 : units.torque());
  const Pose place = inverse(body.pose) * world_pose(found.world, units);
  force.point = own ? body.center_of_mass : place.position;
  if (force.body_axes && !own) {
    force.force = rotate(place.orientation, force.force);
    force.torque = rotate(place.orientation, force.torque);
  }
  if (!(force.force == zero && force.torque == zero)) {
    body.settings.forces.push_back(force);
  }
}

class RigidBodyReader {
 public:
  RigidBodyReader(ReadState& state, Index body)
      : state_(state), found_(state.prim_of_body(body)), body_(state.scene.bodies[body]) {}

  void run() {
    speed("physxRigidBody:maxLinearVelocity", state_.units.length,
          body_.settings.max_linear_velocity);
    speed("physxRigidBody:maxAngularVelocity", kRadians, body_.settings.max_angular_velocity);
    body_.settings.locked_translation = axes("physxRigidBody:lockedPosAxis");
    body_.settings.locked_rotation = axes("physxRigidBody:lockedRotAxis");
    body_.settings.gyroscopic = flag("physxRigidBody:enableGyroscopicForces");
    body_.settings.solves_contacts = flag("physxRigidBody:solveContact");
    body_.parts.physx = read_physx_settings(found_.prim, "physxRigidBody:", state_.units);
  }

 private:
  std::optional<double> number(Token name) const {
    return state_.values.authored_number(found_.prim, name);
  }

  void speed(Token name, double unit, double& value) const {
    const std::optional<double> authored = number(name);
    if (authored && *authored < 0) {
      state_.report(found_.prim, name, Severity::Error, "body.negative-setting",
                    name.str() + " is negative; the speed is not limited",
                    "author a value that is not negative");
    } else if (authored) {
      value = *authored * unit;
    }
  }

  int axes(Token name) const {
    const double authored = number(name).value_or(0);
    return authored > 0 && authored < 256 ? static_cast<int>(authored) & 7 : 0;
  }

  bool flag(Token name) const {
    return state_.values.authored_flag(found_.prim, name).value_or(true);
  }

  ReadState& state_;
  const PhysicsPrim& found_;
  Body& body_;
};

/// By option: what PhysX does to bodies that say nothing.
void take_physx_defaults(ReadState& state, Index index) {
  const PhysicsPrim& found = state.prim_of_body(index);
  Body& body = state.scene.bodies[index];
  const bool has_api = found.roles.has(Api::PhysxRigidBody);
  const auto authored = [&](Token name) {
    return has_api && state.values.authored_number(found.prim, name).has_value();
  };
  if (!authored(state.tokens.physx_angular_damping)) {
    body.angular_damping = kPhysxAngularDamping;
  }
  if (!authored("physxRigidBody:maxAngularVelocity")) {
    body.settings.max_angular_velocity = kPhysxMaxSpin;
  }
}

}  // namespace

void read_body_settings(ReadState& state) {
  for (Index i = 0; i < state.scene.bodies.size(); ++i) {
    if (state.prim_of_body(i).roles.has(Api::PhysxRigidBody)) {
      RigidBodyReader(state, i).run();
    }
    if (state.readings.body_defaults == BodyDefaults::Physx) {
      take_physx_defaults(state, i);
    }
  }
  for (const std::uint32_t i : sorted_prims(
           state.walk, [](const PhysicsPrim& p) { return p.roles.has(Api::PhysxForce); })) {
    read_force(state, state.walk.prims[i]);
  }
}

}  // namespace tenon::physics
