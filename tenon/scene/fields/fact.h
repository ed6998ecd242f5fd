// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "tenon/base/wire.h"
#include "tenon/math/functions.h"
#include "tenon/math/matrix.h"
#include "tenon/math/transform.h"
#include "tenon/math/vector.h"

/// Numbers in values of any shape: how far two are from each other, and all of them in a row.
/// Internal to tenon/scene.
namespace tenon::scene {

/// |a - b| <= tolerance * max(smallest_size, |a|, |b|).
struct Nearness {
  double tolerance = 0;
  double smallest_size = 1;
};

inline constexpr double kNoMeasure = kInfinity;

/// 0 where two numbers are near each other, else their difference; kNoMeasure where there is none.
inline double distance(double a, double b, const Nearness& near) {
  if (a == b || (std::isnan(a) && std::isnan(b))) {
    return 0;
  }
  const double apart = std::fabs(a - b);
  if (!std::isfinite(apart)) {
    return kNoMeasure;
  }
  const double size = std::max({near.smallest_size, std::fabs(a), std::fabs(b)});
  return apart <= near.tolerance * size ? 0 : apart;
}

template <class T>
inline constexpr bool kIsQuat = std::is_same_v<T, Quatd>;

template <class T>
double distance(const T& a, const T& b, const Nearness& near);

template <class T>
double largest_distance(const T& a, const T& b, const Nearness& near) {
  if (a.size() != b.size()) {
    return kNoMeasure;
  }
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, distance(a[i], b[i], near));
  }
  return largest;
}

inline double rotation_distance(const Quatd& a, const Quatd& b, const Nearness& near) {
  return std::max({distance(a.w, b.w, near), distance(a.x, b.x, near), distance(a.y, b.y, near),
                   distance(a.z, b.z, near)});
}

/// Lists whose items have the same bytes, as those of meshes that nobody touched; of all else
/// false.
template <class T>
bool same_bytes(const T& a, const T& b) {
  if constexpr (wire::kIsVector<T>) {
    if constexpr (std::is_trivially_copyable_v<typename T::value_type>) {
      return a.size() == b.size() &&
             (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
    }
  }
  return false;
}

/// Of anything that numbers are in; of all else kNoMeasure where the two differ.
template <class T>
double distance(const T& a, const T& b, const Nearness& near) {
  if (same_bytes(a, b) || a == b) {
    return 0;  // as most are
  }
  if constexpr (std::is_same_v<T, bool> || std::is_enum_v<T>) {
    return kNoMeasure;
  } else if constexpr (std::is_arithmetic_v<T>) {
    return distance(static_cast<double>(a), static_cast<double>(b), near);
  } else if constexpr (kIsQuat<T>) {
    // q and -q are one rotation.
    return std::min(rotation_distance(a, b, near),
                    rotation_distance(a, {-b.x, -b.y, -b.z, -b.w}, near));
  } else if constexpr (std::is_same_v<T, Pose>) {
    return std::max(distance(a.position, b.position, near),
                    distance(a.orientation, b.orientation, near));
  } else if constexpr (wire::kIsVector<T> || wire::kIsArray<T>) {
    return largest_distance(a, b, near);
  } else if constexpr (requires { a.v; }) {
    return largest_distance(a.v, b.v, near);
  } else if constexpr (requires { a.m; }) {
    return largest_distance(a.m, b.m, near);
  } else if constexpr (wire::kIsPair<T>) {
    return std::max(distance(a.first, b.first, near), distance(a.second, b.second, near));
  } else {
    return kNoMeasure;
  }
}

/// The numbers of a value, one after the other; of rotations w, x, y, z.
template <class T>
void add_numbers(const T& value, std::vector<double>& numbers) {
  if constexpr (std::is_arithmetic_v<T>) {
    numbers.push_back(static_cast<double>(value));
  } else if constexpr (kIsQuat<T>) {
    numbers.insert(numbers.end(), {value.w, value.x, value.y, value.z});
  } else if constexpr (std::is_same_v<T, Pose>) {
    add_numbers(value.position, numbers);
    add_numbers(value.orientation, numbers);
  } else if constexpr (wire::kIsPair<T>) {
    add_numbers(value.first, numbers);
    add_numbers(value.second, numbers);
  } else if constexpr (requires { value.v; }) {
    add_numbers(value.v, numbers);
  } else if constexpr (requires { value.m; }) {
    add_numbers(value.m, numbers);
  } else {
    for (const auto& item : value) {
      add_numbers(item, numbers);
    }
  }
}

/// "linear velocity" of "linearVelocity", "body 0" of "body0".
inline std::string in_words(std::string_view camel) {
  std::string words;
  for (const char c : camel) {
    const bool upper = c >= 'A' && c <= 'Z';
    const bool digit = c >= '0' && c <= '9';
    if (upper || digit) {
      words += words.empty() ? "" : " ";
    }
    words += upper ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return words;
}

}  // namespace tenon::scene
