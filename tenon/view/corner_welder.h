// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <unordered_map>

#include "tenon/view/view_scene.h"

/// Internal to this folder.
namespace tenon::view {

/// What one corner of a triangle is made of.
struct Corner {
  std::uint32_t point = 0;  ///< number of it; corners of different numbers are never one
  Vec3f position;
  Vec3f normal;
  Vec2f st;
  Vec3f color;
};

/// Makes a mesh of corners: those that are alike become one point of it.
class CornerWelder {
 public:
  CornerWelder(bool normals, bool st, bool colors) : normals_(normals), st_(st), colors_(colors) {}

  void add(const Corner& corner) {
    const auto [at, is_new] =
        known_.emplace(Key{corner.point, bits(corner)}, static_cast<std::uint32_t>(known_.size()));
    mesh_.corners.push_back(at->second);
    if (!is_new) {
      return;
    }
    mesh_.points.push_back(corner.position);
    if (normals_) {
      mesh_.normals.push_back(corner.normal);
    }
    if (st_) {
      mesh_.st.push_back(corner.st);
    }
    if (colors_) {
      mesh_.colors.push_back(corner.color);
    }
  }

  ViewMesh take() { return std::move(mesh_); }

 private:
  struct Key {
    std::uint32_t point;
    std::array<std::uint32_t, 8> rest;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t sum = key.point;
      for (const std::uint32_t part : key.rest) {
        sum = (sum ^ part) * 0x9e3779b97f4a7c15ull;
        sum ^= sum >> 29;
      }
      return sum;
    }
  };

  std::array<std::uint32_t, 8> bits(const Corner& corner) const {
    std::array<std::uint32_t, 8> result{};
    for (std::size_t i = 0; i < 3; ++i) {
      result[i] = normals_ ? std::bit_cast<std::uint32_t>(corner.normal[i]) : 0;
      result[3 + i] = colors_ ? std::bit_cast<std::uint32_t>(corner.color[i]) : 0;
    }
    for (std::size_t i = 0; i < 2; ++i) {
      result[6 + i] = st_ ? std::bit_cast<std::uint32_t>(corner.st[i]) : 0;
    }
    return result;
  }

  bool normals_;
  bool st_;
  bool colors_;
  ViewMesh mesh_;
  std::unordered_map<Key, std::uint32_t, Hash> known_;
};

}  // namespace tenon::view
