// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "tenon/math/functions.h"
#include "tenon/math/half.h"

namespace tenon {

/// N numbers in a row, laid out as in memory-mapped files.
template <class T, std::size_t N>
struct Vec {
  std::array<T, N> v{};

  constexpr T& operator[](std::size_t i) { return v[i]; }
  constexpr const T& operator[](std::size_t i) const { return v[i]; }
  constexpr bool operator==(const Vec&) const = default;

  constexpr Vec& operator+=(const Vec& o) {
    for (std::size_t i = 0; i < N; ++i) {
      v[i] += o.v[i];
    }
    return *this;
  }
  constexpr Vec& operator-=(const Vec& o) {
    for (std::size_t i = 0; i < N; ++i) {
      v[i] -= o.v[i];
    }
    return *this;
  }
  constexpr Vec& operator*=(T s) {
    for (std::size_t i = 0; i < N; ++i) {
      v[i] *= s;
    }
    return *this;
  }
  friend constexpr Vec operator+(Vec a, const Vec& b) { return a += b; }
  friend constexpr Vec operator-(Vec a, const Vec& b) { return a -= b; }
  friend constexpr Vec operator-(Vec a) { return a *= T(-1); }
  friend constexpr Vec operator*(Vec a, T s) { return a *= s; }
  friend constexpr Vec operator*(T s, Vec a) { return a *= s; }
};

using Vec2d = Vec<double, 2>;
using Vec3d = Vec<double, 3>;
using Vec4d = Vec<double, 4>;
using Vec2f = Vec<float, 2>;
using Vec3f = Vec<float, 3>;
using Vec4f = Vec<float, 4>;
using Vec2h = Vec<Half, 2>;
using Vec3h = Vec<Half, 3>;
using Vec4h = Vec<Half, 4>;
using Vec2i = Vec<std::int32_t, 2>;
using Vec3i = Vec<std::int32_t, 3>;
using Vec4i = Vec<std::int32_t, 4>;

template <std::size_t N>
constexpr double dot(const Vec<double, N>& a, const Vec<double, N>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < N; ++i) {
    sum += a[i] * b[i];
  }
  return sum;
}

/// Written out, since a loop is not unrolled where this is called for every point of a mesh.
template <class T>
bool is_finite(const Vec<T, 2>& a) {
  return is_finite(a[0]) && is_finite(a[1]);
}
template <class T>
bool is_finite(const Vec<T, 3>& a) {
  return is_finite(a[0]) && is_finite(a[1]) && is_finite(a[2]);
}

inline Vec3d cross(const Vec3d& a, const Vec3d& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

template <std::size_t N>
double length(const Vec<double, N>& a) {
  return square_root(dot(a, a));
}

/// Unit vector of `a`, safe for tiny and huge lengths; `fallback` when `a` is zero or not finite.
inline Vec3d normalized(Vec3d a, Vec3d fallback = {}) {
  double largest = 0;
  for (const double part : a.v) {
    largest = absolute(part) > largest ? absolute(part) : largest;
  }
  if (!(largest > 0) || !is_finite(largest)) {
    return fallback;
  }
  a *= 1 / largest;
  return a * (1 / length(a));
}

template <std::size_t N, class T>
Vec<double, N> to_double(const Vec<T, N>& a) {
  Vec<double, N> result;
  for (std::size_t i = 0; i < N; ++i) {
    result[i] = static_cast<double>(a[i]);
  }
  return result;
}

template <std::size_t N>
Vec<float, N> to_float(const Vec<double, N>& a) {
  Vec<float, N> result;
  for (std::size_t i = 0; i < N; ++i) {
    result[i] = static_cast<float>(a[i]);
  }
  return result;
}

}  // namespace tenon
