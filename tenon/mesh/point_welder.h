// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "tenon/math/vector.h"

namespace tenon::mesh {

/// Gives equal points one number: equal to the last bit (0 and -0 are one), nothing is rounded.
/// Numbers go up in the order of first use.
class PointWelder {
 public:
  explicit PointWelder(std::size_t corner_count) {
    // A closed mesh has one point for about six corners: most are found at the first look.
    while (slot_count() < corner_count / 2) {
      ++bits_;
    }
    clear_slots();
    points_.reserve(corner_count / 6);
  }

  std::int32_t number(const Vec3f& point) {
    const Vec3f plain{{point[0] + 0.0f, point[1] + 0.0f, point[2] + 0.0f}};  // -0 becomes 0
    const std::size_t at = find(Bits(plain));
    return slots_[at] < 0 ? add(plain, at) : slots_[at];
  }

  std::vector<Vec3f> take_points() { return std::move(points_); }

 private:
  struct Bits {
    explicit Bits(const Vec3f& point) {
      std::memcpy(&xy, point.v.data(), sizeof(xy));
      std::memcpy(&z, point.v.data() + 2, sizeof(z));
    }
    bool operator==(const Bits&) const = default;
    std::uint64_t xy = 0;
    std::uint32_t z = 0;
  };

  /// The high bits of the products are well mixed, the low ones are not.
  std::size_t first_slot(const Bits& bits) const {
    const std::uint64_t mixed = bits.xy * 0x9E3779B97F4A7C15ull;
    return static_cast<std::size_t>(((mixed ^ mixed >> 32u ^ bits.z) * 0xD6E8FEB86659FD93ull) >>
                                    (64u - bits_));
  }
  std::size_t find(const Bits& bits) const {
    const std::int32_t* const slots = slots_.data();
    const Vec3f* const points = points_.data();
    std::size_t at = first_slot(bits);
    while (slots[at] >= 0 && !(Bits(points[slots[at]]) == bits)) {
      at = (at + 1) & (slot_count() - 1);
    }
    return at;
  }
  std::int32_t add(const Vec3f& point, std::size_t at) {
    const auto number = static_cast<std::int32_t>(points_.size());
    slots_[at] = number;
    points_.push_back(point);
    if (points_.size() >= max_points_) {
      grow();
    }
    return number;
  }
  void clear_slots() {
    slots_.assign(slot_count(), -1);
    max_points_ = slot_count() / 4 * 3;
  }
  void grow() {
    ++bits_;
    clear_slots();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      slots_[find(Bits(points_[i]))] = static_cast<std::int32_t>(i);
    }
  }

  std::size_t slot_count() const { return std::size_t{1} << bits_; }

  std::vector<Vec3f> points_;
  std::vector<std::int32_t> slots_;
  std::size_t max_points_ = 0;  // that the slots have room for
  unsigned bits_ = 6;
};

}  // namespace tenon::mesh
