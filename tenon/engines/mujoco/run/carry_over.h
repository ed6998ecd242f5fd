// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "tenon/base/result.h"
#include "tenon/engines/mujoco/model.h"
#include "tenon/engines/simulation.h"
#include "tenon/scene/timeline/timeline.h"

/// What goes from one model of a scene to the next, when the scene changed so much that the model
/// is made anew. Poses and velocities of bodies go through the scene.
namespace tenon::engines::mujoco {

/// Coordinates of joints that are in both trees: they know turns that poses do not.
void carry_joints_over(const Model& last, Model& next);

/// Lets a body that became a part of another bring its momentum along, as in a plastic impact:
/// changes the generalized velocities of a model whose positions are set. The body's velocities
/// are those that it had before.
void join_momentum(const scene::Body& body, const BodyMap& map, Model& model);

/// The model of a scene as it is in the middle of a run, said nothing about.
Result<Model> model_in_the_middle(const scene::PhysicsScene& scene, SimulationOptions options,
                                  double time_step);

/// A timeline whose merged bodies get what MuJoCo still moves.
std::unique_ptr<scene::Timeline> timeline_of(const scene::PhysicsScene& scene);

/// The two give a joint the same coordinates.
bool same_coordinates(const JointDofs& a, const JointDofs& b);

}  // namespace tenon::engines::mujoco
