// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <type_traits>

#include "tenon/base/path.h"
#include "tenon/base/wire.h"
#include "tenon/math/transform.h"
#include "tenon/scene/fields/scene_fields.h"

namespace tenon::scene {

inline constexpr double kNear = 1e-9;

/// Equal but for what rounding makes of numbers, as deep as they lie: within kNear, relative to the
/// larger one, of vectors and matrices to their largest number, of poses in metres.
template <class T>
bool near_fields(const T& a, const T& b);

/// The same of numbers next to each other, of which the largest gives the scale.
template <class Numbers>
bool near_numbers(const Numbers& a, const Numbers& b, double scale = 0) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    scale = std::max({scale, std::fabs(a[i]), std::fabs(b[i])});
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!(a[i] == b[i] || std::fabs(a[i] - b[i]) <= kNear * scale)) {
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

template <class T>
bool near_fields(const T& a, const T& b) {
  if constexpr (std::is_floating_point_v<T>) {
    return a == b || std::fabs(a - b) <= kNear * std::max(std::fabs(a), std::fabs(b)) ||
           (std::isnan(a) && std::isnan(b));
  } else if constexpr (wire::kIsOptional<T>) {
    return a.has_value() == b.has_value() && (!a || near_fields(*a, *b));
  } else if constexpr (wire::kIsPair<T>) {
    return near_fields(a.first, b.first) && near_fields(a.second, b.second);
  } else if constexpr (wire::kIsVector<T> || wire::kIsArray<T>) {
    bool same = a.size() == b.size();
    for (std::size_t i = 0; same && i < a.size(); ++i) {
      same = near_fields(a[i], b[i]);
    }
    return same;
  } else if constexpr (std::is_same_v<T, Pose>) {
    return near_poses(a, b);
  } else if constexpr (std::is_same_v<T, Vec3d>) {
    return near_numbers(a.v, b.v);
  } else if constexpr (std::is_same_v<T, Mat3d>) {
    return near_matrices(a, b);
  } else if constexpr (HasTable<T>) {
    bool same = true;
    each_field_of_both(a, b, [&](const FieldInfo&, const auto& x, const auto& y) {
      same = same && near_fields(x, y);
    });
    return same;
  } else {
    return a == b;
  }
}

}  // namespace tenon::scene
