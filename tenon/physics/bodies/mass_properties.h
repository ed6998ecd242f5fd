// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/math/inertia.h"
#include "tenon/math/transform.h"
#include "tenon/physics/readings.h"
#include "tenon/physics/scene_names.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/scene/shapes/mesh_inertia.h"

namespace tenon::physics {

inline constexpr double kDefaultDensity = 1000;  ///< [kg/m^3] where none is authored (S-39)
inline constexpr double kDefaultMass = 1;  ///< units of mass, of a body without colliders (S-42)
inline constexpr double kDefaultRadius = 0.1;  ///< [m] of the ball that gives its inertia (M-18)

/// The authored mass properties of one prim, in SI; absent where unset (S-41, S-44..S-46).
struct AuthoredMass {
  std::optional<double> mass;     ///< [kg]
  std::optional<double> density;  ///< [kg/m^3]
  std::optional<Vec3d> center;    ///< of mass, in the frame of the body [m]
  std::optional<Mat3d> inertia;   ///< about the centre of mass, axes of the body [kg m^2]
};

/// Mass, centre of mass and inertia about it, in one frame.
struct MassProperties {
  double mass = 0;  ///< [kg]
  Vec3d center;     ///< [m]
  Mat3d inertia;    ///< about `center` [kg m^2]
};

/// A solid of density 1 placed in a frame.
SolidIntegrals placed(const SolidIntegrals& solid, const Pose& pose);

/// One collider: its own mass wins over a density (S-39, M-13).
MassProperties collider_mass(const SolidIntegrals& solid_in_body, const AuthoredMass& authored,
                             double density);

/// Sum of parts about their common centre of mass (M-12).
MassProperties sum_masses(const std::vector<MassProperties>& parts);

/// All of it times mass / its mass (M-14).
MassProperties scaled_to(MassProperties whole, double mass);

/// What the body's own mass API says over the sum of its colliders (M-14..M-18). A `sum` of zero
/// mass means that there are no shapes to weigh.
MassProperties body_mass(const MassProperties& sum, const AuthoredMass& authored,
                         CenterShift shift = CenterShift::ParallelAxis);

/// Moments are positive (or all zero) and no one exceeds the sum of the others (S-45, M-19).
bool satisfies_triangle_rule(const Vec3d& moments);
bool is_positive_definite(const Mat3d& inertia);

}  // namespace tenon::physics
