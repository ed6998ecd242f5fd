// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/check/unit_signs.h"

#include <algorithm>
#include <cmath>

#include "tenon/check/extents.h"
#include "tenon/physics/attribute_values.h"

namespace tenon::check {
namespace {

using scene::Index;

constexpr double kSmallestOfScene = 0.01;  ///< [m] across the largest body

/// Authored gravities of the stage's scenes, in its units.
std::vector<double> authored_gravities(const Subject& subject) {
  std::vector<double> found;
  for (const stage::Prim& prim : subject.prims) {
    const std::optional<double> value = prim.type_name() == "PhysicsScene"
                                            ? authored_number(prim, "physics:gravityMagnitude")
                                            : std::nullopt;
    if (value && *value > 0) {
      found.push_back(*value);
    }
  }
  return found;
}

bool has_density_of_matter(const Subject& subject, Index body) {
  const std::optional<double> density = mean_density(subject, body);
  return !density || (!is_heavier_than_matter(*density) && !is_lighter_than_air(*density));
}

}  // namespace

bool may_be_kilograms(const Subject& subject) {
  for (Index i = 0; i < subject.scene.bodies.size(); ++i) {
    if (!has_density_of_matter(subject, i)) {
      return false;
    }
  }
  return true;
}

bool may_be_centimetres(const Subject& subject) {
  double largest = 0;
  for (Index i = 0; i < subject.scene.bodies.size(); ++i) {
    const Extent extent = extent_of(subject, i);
    largest = extent.empty() ? largest : std::fmax(largest, 2 * extent.half_diagonal());
  }
  const std::vector<double> gravities = authored_gravities(subject);
  const bool weak = std::any_of(gravities.begin(), gravities.end(),
                                [](double gravity) { return gravity * 0.01 < 0.5; });
  return may_be_kilograms(subject) && !weak && !(largest > 0 && largest < kSmallestOfScene);
}

bool may_have_y_up(const Subject& subject) {
  for (const stage::Prim& prim : subject.prims) {
    const auto direction = prim.type_name() == "PhysicsScene"
                               ? prim.attribute("physics:gravityDirection").get_as<Vec3f>()
                               : std::nullopt;
    if (direction && std::fabs((*direction)[1]) <
                         std::fmax(std::fabs((*direction)[0]), std::fabs((*direction)[2]))) {
      return false;
    }
  }
  return true;
}

}  // namespace tenon::check
