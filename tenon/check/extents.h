// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>

#include "tenon/check/subject.h"
#include "tenon/math/vector.h"

namespace tenon::check {

/// Volume of the enabled colliders of a body and a box around them in the body's frame [m].
struct Extent {
  double volume = 0;
  Vec3d low{{kInfinity, kInfinity, kInfinity}};
  Vec3d high{{-kInfinity, -kInfinity, -kInfinity}};

  bool empty() const { return !(low[0] <= high[0]); }
  Vec3d middle() const { return (low + high) * 0.5; }
  double half_diagonal() const { return length(high - low) / 2; }
};

Extent extent_of(const Subject& subject, scene::Index body);

/// From here on a centre of mass is far from a body, in half diagonals from its middle.
inline constexpr double kFarCenter = 10;

/// Density of a body whose mass is authored or follows from densities [kg/m^3]; none without a
/// volume.
std::optional<double> mean_density(const Subject& subject, scene::Index body);
/// Whether matter has such a density, with room for hollow and for coarse colliders.
bool is_heavier_than_matter(double density);
bool is_lighter_than_air(double density);

/// The smallest width of a shape along its axes [m]; infinite for planes.
double thickness_of(const scene::PhysicsScene& scene, const scene::Shape& shape);
/// That of the thickest enabled collider of a body [m]; 0 without one.
double thickness_of_body(const Subject& subject, scene::Index body);

/// A world box around a collider: low and high corner [m]; infinite for planes.
std::pair<Vec3d, Vec3d> world_bounds(const scene::PhysicsScene& scene,
                                     const scene::Collider& collider);

}  // namespace tenon::check
