// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/scene/joint_dofs.h"
#include "tenon/scene/motion/fit_velocities.h"
#include "tenon/scene/physics_scene.h"

/// Where a run begins: the same for every engine that has joint coordinates.
namespace tenon::engines {

/// Coordinates of a joint of a tree [m or rad], in the order of coordinates_at(): read off the
/// poses of the bodies, or the authored one of a joint that has one. What they cannot express, so
/// that the tree pulls the frames together, is reported (S-90, rule joint.frames-apart).
std::vector<double> start_coordinates(const scene::PhysicsScene& scene, const scene::Joint& joint,
                                      const scene::JointDofs& dofs, Diagnostics& diagnostics);

/// What joints took from the authored velocities of bodies (rule joint.velocities-apart), and links
/// whose velocities do not act (rule articulation.link-velocity).
void report_lost_energy(const scene::PhysicsScene& scene, const scene::FittedVelocities& fitted,
                        Diagnostics& diagnostics);

}  // namespace tenon::engines
