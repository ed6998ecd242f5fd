// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/dynamics/multibody.h"
#include "tenon/math/vector.h"

namespace tenon::dynamics {

/// Rows one after the other.
struct DenseMatrix {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<double> values;  // (rows x columns)

  double& at(std::size_t row, std::size_t column) { return values[row * columns + column]; }
  double at(std::size_t row, std::size_t column) const { return values[row * columns + column]; }
};

/// What a force along one coordinate has to accelerate, armature included [kg m^2 or kg]. What
/// rigid mimics and loops tie to the coordinate moves along; floating bodies are free. 0 where
/// nothing that has mass moves; infinite where it cannot move.
struct EffectiveInertia {
  double held = 0;  ///< all other joints stand still against their parents
  double free = 0;  ///< all other joints move as they like
};

/// The algebra of a multibody at one posture. Shapes name dof_count, that of
/// Multibody::coordinates(); velocities and forces are along these. What was found is kept, so that
/// one object belongs to one thread.
class Dynamics {
 public:
  /// `multibody` must outlive it.
  Dynamics(const Multibody& multibody, Posture posture);
  Dynamics(Dynamics&&) noexcept;
  Dynamics& operator=(Dynamics&&) noexcept;
  ~Dynamics();

  const Posture& posture() const;

  /// (dof_count x dof_count) [kg, kg m, kg m^2], armature included, of the trees alone: loops and
  /// mimics are constraints on it. Errors: Limit beyond limits::kDenseCoordinates.
  Result<DenseMatrix> mass_matrix() const;
  /// What gravity exerts along each coordinate [N, N m] (dof_count); the forces that hold the
  /// multibody still are the opposite.
  std::vector<double> gravity_forces() const;
  /// Coriolis and centrifugal forces [N, N m] (dof_count): M a + bias = forces + gravity_forces.
  std::vector<double> bias_forces(const std::vector<double>& velocities) const;
  /// (6 x dof_count): velocity of the body's point that is at `point` [m, world], then its angular
  /// velocity, both along the axes of the world.
  DenseMatrix jacobian(Index body, const Vec3d& point) const;
  double mass() const;           ///< of all bodies that are not kinematic [kg]
  Vec3d center_of_mass() const;  ///< of these, world [m]
  EffectiveInertia effective_inertia(std::size_t coordinate) const;
  /// What `forces` along the coordinates (dof_count) exert along one when all others are held as in
  /// EffectiveInertia::held, and floating bodies, too [N m or N]: what its drive has to balance.
  /// Not finite where that motion is not.
  double along_held(std::size_t coordinate, const std::vector<double>& forces) const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace tenon::dynamics
