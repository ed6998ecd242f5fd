// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/urdf/gazebo_colors.h"

#include <algorithm>
#include <iterator>

namespace tenon::urdf {
namespace {

struct NamedColor {
  std::string_view name;
  Vec4d color;
};

/// Gazebo's own materials that are one colour.
constexpr NamedColor kColors[] = {
    {"Black", {{0, 0, 0, 1}}},
    {"Blue", {{0, 0, 1, 1}}},
    {"DarkGrey", {{0.175, 0.175, 0.175, 1}}},
    {"DarkYellow", {{0.7, 0.7, 0, 1}}},
    {"FlatBlack", {{0.1, 0.1, 0.1, 1}}},
    {"Green", {{0, 1, 0, 1}}},
    {"Grey", {{0.7, 0.7, 0.7, 1}}},
    {"Indigo", {{0.33, 0, 0.5, 1}}},
    {"Orange", {{1, 0.5, 0, 1}}},
    {"Purple", {{1, 0, 1, 1}}},
    {"Red", {{1, 0, 0, 1}}},
    {"Turquoise", {{0, 1, 1, 1}}},
    {"White", {{1, 1, 1, 1}}},
    {"Yellow", {{1, 1, 0, 1}}},
};

}  // namespace

std::optional<Vec4d> gazebo_color(std::string_view material) {
  constexpr std::string_view kStart = "Gazebo/";
  if (!material.starts_with(kStart)) {
    return std::nullopt;
  }
  const auto known = std::find_if(
      std::begin(kColors), std::end(kColors),
      [&](const NamedColor& color) { return color.name == material.substr(kStart.size()); });
  return known == std::end(kColors) ? std::nullopt : std::optional(known->color);
}

}  // namespace tenon::urdf
