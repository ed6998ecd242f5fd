// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "tenon/base/result.h"
#include "tenon/engines/mujoco/model.h"
#include "tenon/engines/steering.h"

/// What a user sets, written into a model.
namespace tenon::engines::mujoco {

/// Gravity of all scenes [m/s^2] and the wrenches on bodies.
void write_gravity(const scene::PhysicsScene& scene, const Steering& steering, Model& model);

/// Joint efforts, before a step. derive_motion() must have run.
void write_efforts(const scene::PhysicsScene& scene, const Steering& steering, Model& model);

/// A parameter of bodies, colliders and joints; not those of drives. Errors: Unsupported where the
/// model has nothing that it could act on.
Result<void> write_parameter(const scene::PhysicsScene& scene, const ParameterKey& key,
                             double value, Model& model);

/// Coordinates and velocities of a joint of the tree. Errors: Unsupported for others.
Result<void> write_joint_state(const scene::PhysicsScene& scene, scene::Index joint,
                               const JointState& state, Model& model);

/// Pose and velocity of a free body. Errors: Unsupported for others.
Result<void> write_body_state(const scene::PhysicsScene& scene, scene::Index body,
                              const BodyState& state, Model& model);

/// Index into Model::drives, or -1: the model has no such drive.
int find_drive(const Model& model, scene::Index joint, scene::Index drive);

}  // namespace tenon::engines::mujoco
