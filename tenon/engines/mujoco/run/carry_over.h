// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/result.h"
#include "tenon/engines/mujoco/model.h"
#include "tenon/engines/simulation.h"

/// The state carried from one model of a scene to the next, when the scene changed so much that the
/// model is rebuilt. Poses and velocities of bodies go through the scene, where a new joint or
/// merged body acts by its impulse.
namespace tenon::engines::mujoco {

/// Coordinates of joints that are in both trees: they know turns that poses do not.
void carry_joints_over(const Model& last, Model& next);

/// The model of a scene as it is in the middle of a run, said nothing about.
Result<Model> model_in_the_middle(const scene::PhysicsScene& scene, SimulationOptions options,
                                  double time_step);

/// The two give a joint the same coordinates.
bool same_coordinates(const scene::JointDofs& a, const scene::JointDofs& b);

}  // namespace tenon::engines::mujoco
