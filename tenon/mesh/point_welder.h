// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "tenon/math/vector.h"

namespace tenon::mesh {

/// Gives equal points one number: equal to the last bit (0 and -0 are one), nothing is rounded.
/// Numbers go up in the order of first use.
class PointWelder {
 public:
  explicit PointWelder(std::size_t corner_count) {
    std::size_t size = 64;
    while (size < corner_count) {  // a closed mesh has one point for about six corners
      size *= 2;
    }
    slots_.assign(size, -1);
  }

  std::int32_t number(Vec3f point) {
    for (std::size_t i = 0; i < 3; ++i) {
      point[i] += 0.0f;  // -0 becomes 0
    }
    if (points_.size() * 4 >= slots_.size() * 3) {
      grow();
    }
    std::int32_t& slot = slots_[find(point)];
    if (slot < 0) {
      slot = static_cast<std::int32_t>(points_.size());
      points_.push_back(point);
    }
    return slot;
  }

  std::vector<Vec3f> take_points() { return std::move(points_); }

 private:
  static std::uint64_t hash(const Vec3f& p) {
    std::uint64_t h = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      h = (h ^ std::bit_cast<std::uint32_t>(p[i])) * 0x9E3779B97F4A7C15ull;
      h ^= h >> 29u;
    }
    return h;
  }
  static bool same(const Vec3f& a, const Vec3f& b) {
    return std::bit_cast<std::uint32_t>(a[0]) == std::bit_cast<std::uint32_t>(b[0]) &&
           std::bit_cast<std::uint32_t>(a[1]) == std::bit_cast<std::uint32_t>(b[1]) &&
           std::bit_cast<std::uint32_t>(a[2]) == std::bit_cast<std::uint32_t>(b[2]);
  }
  std::size_t find(const Vec3f& point) const {
    std::size_t at = hash(point) & (slots_.size() - 1);
    while (slots_[at] >= 0 && !same(points_[static_cast<std::size_t>(slots_[at])], point)) {
      at = (at + 1) & (slots_.size() - 1);
    }
    return at;
  }
  void grow() {
    slots_.assign(slots_.size() * 2, -1);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      slots_[find(points_[i])] = static_cast<std::int32_t>(i);
    }
  }

  std::vector<Vec3f> points_;
  std::vector<std::int32_t> slots_;
};

}  // namespace tenon::mesh
