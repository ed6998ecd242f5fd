// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Properties of the scene that PhysX 5.1 does not support here; none is ignored silently.
#include <algorithm>

#include "tenon/engines/foreign_settings.h"
#include "tenon/engines/physx/build/build.h"
#include "tenon/engines/physx/run/drives.h"
#include "tenon/engines/physx/slots.h"
#include "tenon/engines/scene_timeline.h"
#include "tenon/math/inertia.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::engines::physx {
namespace {

using scene::Index;
using scene::Joint;

void report_body(Build& build, Index index) {
  const scene::Body& body = build.scene.bodies[index];
  if (!(body.mass >= kMinMass)) {
    build.report(body.path, "physics:mass",
                 "PhysX takes a massless body for an infinitely heavy one; 1e-9 kg is used");
  }
  const Vec3d moments = principal_inertia(body.inertia).moments;
  if (!(std::min({moments[0], moments[1], moments[2]}) >= kMinMoment)) {
    build.report(body.path, "physics:diagonalInertia",
                 "PhysX never turns a body without inertia; principal moments are raised to 1e-13");
  }
  const scene::BodySettings& settings = body.settings;
  const bool locks = settings.locked_translation != 0 || settings.locked_rotation != 0;
  if (locks && build.model.is_link(index)) {
    build.report(body.path, "physxRigidBody:lockedPosAxis",
                 "PhysX locks axes of bodies outside of articulations only");
  }
}

void report_drives(Build& build, Index index) {
  const Joint& joint = build.scene.joints[index];
  const JointMap& map = build.model.joints[index];
  int swings = 0;
  for (const scene::Dof dof : kSlotDofs) {
    const bool driven = is_driven(joint, dof);
    if (driven && joint.friction > 0) {
      build.report(joint.path, "friction",
                   "joint friction is dropped: PhysX cannot combine it with a drive");
    }
    if (driven && map.d6 != nullptr && has_spring(joint) && !acts_beside_drive(joint, map, dof)) {
      build.report(joint.path, "damping",
                   "beside a drive of bounded force or by acceleration joints outside of "
                   "articulations have no spring or damper");
    }
    swings += driven && map.d6 != nullptr && is_angular(dof) && slot_of(dof, map.main).number != 0;
  }
  if (swings > 1) {
    build.report(joint.path, "drive",
                 "PhysX drives both swings of a joint with the gains of the last one");
  }
  if (has_spring(joint) && joint.friction > 0) {
    build.report(joint.path, "friction",
                 "joint friction is dropped: PhysX cannot combine it with a spring");
  }
}

void report_joint(Build& build, Index index) {
  const Joint& joint = build.scene.joints[index];
  const JointMap& map = build.model.joints[index];
  if (map.role == JointRole::None) {
    return;
  }
  if (joint.collision_enabled && (map.role == JointRole::Reduced)) {
    build.report(joint.path, "physics:collisionEnabled",
                 "links of an articulation that share a joint never touch in PhysX");
  }
  report_drives(build, index);
  for (const scene::LimitSpring& spring : joint.limit_springs) {
    if (spring.restitution > 0) {
      build.report(joint.path, "restitution", "limits of PhysX here do not rebound");
    }
  }
  for (const scene::Drive& drive : joint.drives) {
    const scene::DriveEnvelope& envelope = drive.envelope;
    if (envelope.max_velocity < scene::kUnlimited || envelope.velocity_resistance > 0) {
      build.report(joint.path, "drive",
                   "PhysX 5.1 bounds the force of a drive, not what it has left at a speed");
    }
  }
  if (map.role == JointRole::Maximal && (joint.initial_position || joint.initial_velocity)) {
    build.report(
        joint.path, "state",
        "joints outside of articulations start with the poses and velocities of their bodies");
  }
  if (map.role == JointRole::Maximal && joint.armature > 0) {
    build.report(joint.path, "armature", "joints outside of articulations have none in PhysX");
  }
  if (map.role == JointRole::Maximal && joint.velocity_limit < scene::kUnlimited) {
    build.report(joint.path, "velocity", "joints outside of articulations have no speed limit");
  }
}

}  // namespace

void report_unmapped(Build& build) {
  report_mujoco_settings(build.scene, build.model.not_mapped);
  for (Index b = 0; b < build.scene.bodies.size(); ++b) {
    report_body(build, b);
  }
  for (Index j = 0; j < build.scene.joints.size(); ++j) {
    report_joint(build, j);
  }
  for (const scene::Collider& collider : build.scene.colliders) {
    const bool has_patch =
        collider.settings.torsional_patch > 0 || collider.settings.min_torsional_patch > 0;
    if (has_patch &&
        build.model.scenes[collider.scene]->getSolverType() == px::PxSolverType::ePGS) {
      build.report(collider.path, "physxCollision:torsionalPatchRadius",
                   "only PhysX's solver TGS (physxScene:solverType) has it");
    }
  }
  for (const scene::Material& material : build.scene.materials) {
    if (material.torsional_friction.value_or(0) > 0 || material.rolling_friction.value_or(0) > 0) {
      build.report(material.path, "torsionalFriction, rollingFriction",
                   "PhysX has friction against sliding, and of patches of a size alone");
    }
  }
  for (const scene::MujocoActuator& actuator : build.scene.actuators) {
    build.report(actuator.path, "", "an actuator of MuJoCo, which PhysX does not have");
  }
}

}  // namespace tenon::engines::physx
