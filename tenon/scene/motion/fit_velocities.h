// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tenon/scene/body_state.h"
#include "tenon/scene/joint_dofs.h"
#include "tenon/scene/joint_forest.h"

/// Velocities that joints allow, from those that bodies have.
namespace tenon::scene {

/// What joints took from bodies whose velocities do not fit them.
struct LostEnergy {
  Index joint = 0;        ///< the one that the velocities fit least, of those that hang together
  double energy = 0;      ///< kinetic, of all bodies that hang together, before [J]
  double lost = 0;        ///< of it [J]
  double speed = 0;       ///< at which the frames of `joint` were to part [m/s]
  double turn_speed = 0;  ///< [rad/s]
};

struct FittedVelocities {
  std::vector<BodyState> bodies;            ///< poses as given (body_count)
  std::vector<std::vector<double>> joints;  ///< speeds in the order of JointDofs (joint_count); of
                                            ///< a ball the angular velocity in frame 0
  std::vector<LostEnergy> losses;           ///< not of what moving kinematic bodies pull along
  std::vector<Index> unused;                ///< links whose own velocity is not used
};

/// Whether a link of an articulation has a velocity of its own, or moves as its parent and the
/// speed of its joint say (S-32).
enum class LinkVelocities : std::uint8_t { OfJoints, Own };

/// Each enabled joint acts at once, by the impulse that makes the velocities fit it: of all
/// velocities that the joints allow, those that differ least from the given ones in kinetic energy.
/// Linear and angular momentum stay where nothing is attached to the world. Kinematic bodies move
/// as given, and joints with an initial velocity of their own have it. `states` (body_count) are
/// where the bodies are and how they would move alone.
FittedVelocities fit_velocities(const PhysicsScene& scene, const JointForest& forest,
                                const std::vector<JointDofs>& dofs,
                                const std::vector<BodyState>& states, LinkVelocities links);

/// How the bodies are and move at the start; kinematic ones as their samples do in the first
/// `time_step` seconds, and those that start asleep not at all. (body_count)
std::vector<BodyState> states_at_start(const PhysicsScene& scene, double time_step);

/// Some body has a velocity or some joint an initial one: without, there is nothing to fit.
bool anything_moves(const PhysicsScene& scene, const std::vector<BodyState>& states);

/// A sentence without a stop: by how much the velocities miss the joint, and what is lost.
std::string words_of(const LostEnergy& loss);

}  // namespace tenon::scene
