// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tenon/math/matrix.h"
#include "tenon/math/transform.h"
#include "tenon/scene/fields/data_type.h"

namespace tenon::scene {

inline constexpr double kNear = 1e-9;

/// Numbers next to each other are near, where the largest of all gives the scale.
template <class Numbers>
bool near_numbers(const Numbers& a, const Numbers& b, double scale = 0) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    scale = std::max({scale, std::fabs(a[i]), std::fabs(b[i])});
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!(a[i] == b[i] || (std::isfinite(scale) && std::fabs(a[i] - b[i]) <= kNear * scale))) {
      return false;
    }
  }
  return true;
}

inline bool near_poses(const Pose& a, const Pose& b) {
  return near_numbers(a.position.v, b.position.v, 1) &&
         length(rotation_vector(conjugate(a.orientation) * b.orientation)) <= kNear;
}

inline bool near_matrices(const Mat3d& a, const Mat3d& b) {
  double scale = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      scale = std::max({scale, std::fabs(a[i][j]), std::fabs(b[i][j])});
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (!near_numbers(a[i], b[i], scale)) {
      return false;
    }
  }
  return true;
}

/// Equal up to the rounding of numbers, at any depth: within kNear, relative to the larger one, for
/// vectors and matrices to their largest number, for poses in metres.
bool near_data(DataView a, DataView b);

template <class T>
bool near_fields(const T& a, const T& b) {
  return near_data(view_of(a), view_of(b));
}

}  // namespace tenon::scene
