// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/fields/near_fields.h"

#include <cmath>

#include "tenon/scene/fields/same_fields.h"

namespace tenon::scene {
namespace {

bool near_reals(double a, double b) {
  const double scale = std::max(std::fabs(a), std::fabs(b));
  return a == b || (std::isfinite(scale) && std::fabs(a - b) <= kNear * scale) ||
         (std::isnan(a) && std::isnan(b));
}

/// Of what is no optional, pair, list or struct.
bool near_leaf(DataView a, DataView b) {
  if (a.kind() == DataKind::Real) {
    return near_reals(a.as<double>(), b.as<double>());
  }
  if (a.kind() == DataKind::Pose) {
    return near_poses(a.as<Pose>(), b.as<Pose>());
  }
  if (a.is_a<Vec3d>()) {
    return near_numbers(a.as<Vec3d>().v, b.as<Vec3d>().v);
  }
  if (a.is_a<Mat3d>()) {
    return near_matrices(a.as<Mat3d>(), b.as<Mat3d>());
  }
  if (a.kind() != DataKind::Numbers || a.type->item->kind != DataKind::Real) {
    return same_data(a, b);
  }
  for (std::size_t i = 0; i < a.type->count; ++i) {
    if (!near_reals((&a.as<double>())[i], (&b.as<double>())[i])) {
      return false;
    }
  }
  return true;
}

}  // namespace

bool near_data(DataView a, DataView b) { return data_agrees(a, b, near_leaf); }

}  // namespace tenon::scene
