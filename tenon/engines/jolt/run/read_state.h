// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "tenon/engines/joint_readings.h"
#include "tenon/engines/jolt/model.h"
#include "tenon/scene/physics_scene.h"

/// Jolt's state in the words of the scene.
namespace tenon::engines::jolt {

BodyState read_body_state(const Model& model, scene::Index body);
/// One side of a joint: where its frame is, and how its body moves.
JointSide read_side(const Model& model, const std::optional<scene::Index>& body, const Pose& frame);
/// Whole turns are counted of coordinates along which something acts.
JointState read_joint_state(const scene::PhysicsScene& scene, const Model& model,
                            scene::Index joint);
Vec3d read_center_of_mass(const Model& model, scene::Index body);
/// `gravity` by scene [m/s^2].
Energy read_energy(const scene::PhysicsScene& scene, const Model& model,
                   std::span<const Vec3d> gravity);

/// What a joint has exerted on body 1 during the last step, about the joint's point, world axes:
/// what holds it together and what acts along its coordinates. Of joints that may break, and of all
/// with Outputs::reactions.
Wrench read_reaction(const Model& model, scene::Index joint);

}  // namespace tenon::engines::jolt
