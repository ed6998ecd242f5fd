// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "tenon/engines/mujoco/model.h"

/// Read-back in the words of the neutral scene. Poses and velocities are those that MuJoCo derived
/// last: it does so at the beginning of a step; derive_motion() brings them up to its end.
namespace tenon::engines::mujoco {

/// Poses and velocities of bodies from the coordinates as they are.
void derive_motion(const Model& model);

BodyState read_body_state(const scene::PhysicsScene& scene, const Model& model, scene::Index body);
/// derive_motion() is needed for joints outside the tree alone.
JointState read_joint_state(const scene::PhysicsScene& scene, const Model& model,
                            scene::Index joint);
/// Kinetic energy of bodies and armatures; potential of gravity (zero at the world's origin) and of
/// passive springs. Kinematic bodies and drives do not count. `gravity` is that of each scene now
/// [m/s^2] (scene_count).
Energy read_energy(const scene::PhysicsScene& scene, const Model& model,
                   std::span<const Vec3d> gravity);
/// The centre of mass of a body, world [m].
Vec3d read_center_of_mass(const Model& model, scene::Index body);
/// Contacts that push.
std::size_t read_contact_count(const Model& model);

/// The pose of a joint frame in the world [m]; `body` without value: the world is the body.
Pose frame_in_world(const Model& model, const std::optional<scene::Index>& body, const Pose& frame);

}  // namespace tenon::engines::mujoco
