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
    while (slot_count() < corner_count / 4) {  // a closed mesh has one point for about six corners
      ++bits_;
    }
    slots_.assign(slot_count(), -1);
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
  /// The high bits of the products are well mixed, the low ones are not.
  std::size_t first_slot(const Vec3f& p) const {
    const std::uint64_t x = std::bit_cast<std::uint32_t>(p[0]);
    const std::uint64_t y = std::bit_cast<std::uint32_t>(p[1]);
    const std::uint64_t z = std::bit_cast<std::uint32_t>(p[2]);
    const std::uint64_t mixed = (x | y << 32u) * 0x9E3779B97F4A7C15ull;
    return static_cast<std::size_t>(((mixed ^ mixed >> 32u ^ z) * 0xD6E8FEB86659FD93ull) >>
                                    (64u - bits_));
  }
  static bool same(const Vec3f& a, const Vec3f& b) {
    return std::bit_cast<std::uint32_t>(a[0]) == std::bit_cast<std::uint32_t>(b[0]) &&
           std::bit_cast<std::uint32_t>(a[1]) == std::bit_cast<std::uint32_t>(b[1]) &&
           std::bit_cast<std::uint32_t>(a[2]) == std::bit_cast<std::uint32_t>(b[2]);
  }
  std::size_t find(const Vec3f& point) const {
    std::size_t at = first_slot(point);
    while (slots_[at] >= 0 && !same(points_[static_cast<std::size_t>(slots_[at])], point)) {
      at = (at + 1) & (slots_.size() - 1);
    }
    return at;
  }
  void grow() {
    ++bits_;
    slots_.assign(slot_count(), -1);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      slots_[find(points_[i])] = static_cast<std::int32_t>(i);
    }
  }

  std::size_t slot_count() const { return std::size_t{1} << bits_; }

  std::vector<Vec3f> points_;
  std::vector<std::int32_t> slots_;
  unsigned bits_ = 6;
};

}  // namespace tenon::mesh
