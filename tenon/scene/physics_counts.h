// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "tenon/scene/physics_scene.h"

namespace tenon::scene {

/// How much of what would be simulated.
struct PhysicsCounts {
  std::size_t scenes = 0;  ///< authored ones
  std::size_t bodies = 0;
  std::size_t kinematic_bodies = 0;
  std::size_t colliders = 0;  ///< enabled, static ones included
  std::size_t static_colliders = 0;
  std::size_t articulations = 0;
  std::size_t drives = 0;
  std::size_t limits = 0;  ///< bounded degrees of freedom
  std::size_t mimics = 0;  ///< degrees of freedom that follow others
  /// Coordinates of the joint forest: of its joints, and six for each tree that floats.
  std::size_t dofs = 0;
  double mass = 0;                      ///< of bodies that move freely [kg]
  std::array<std::size_t, 6> joints{};  ///< by JointKind, enabled ones
};

/// Free degrees of freedom of one joint: 1 for revolute, the axes that no limit locks for a D6.
std::size_t free_dofs(const Joint& joint);

PhysicsCounts count_physics(const PhysicsScene& scene);

}  // namespace tenon::scene
