// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <utility>

#include "tenon/asset/colliders/colliders_asset.h"

namespace tenon {

namespace {

using scene::Approximation;

constexpr std::array<std::pair<const char*, Approximation>, 5> kShortWords{{
    {"hull", Approximation::ConvexHull},
    {"decomposition", Approximation::ConvexDecomposition},
    {"simplification", Approximation::MeshSimplification},
    {"sphere", Approximation::BoundingSphere},
    {"box", Approximation::BoundingCube},
}};

}  // namespace

std::optional<scene::Approximation> approximation_named(const std::string& name) {
  for (const auto& [word, approximation] : kShortWords) {
    if (name == word) {
      return approximation;
    }
  }
  for (int i = 0; i <= static_cast<int>(Approximation::SphereFill); ++i) {
    const auto approximation = static_cast<Approximation>(i);
    if (name == scene::approximation_name(approximation)) {
      return approximation;
    }
  }
  return std::nullopt;
}

std::vector<std::string> approximation_words() {
  std::vector<std::string> words;
  for (int i = 0; i <= static_cast<int>(Approximation::SphereFill); ++i) {
    words.emplace_back(scene::approximation_name(static_cast<Approximation>(i)));
  }
  for (const auto& one : kShortWords) {
    words.emplace_back(one.first);
  }
  return words;
}

}  // namespace tenon
