// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

/// What a model of an engine may hold, beside the limits of tenon/base/limits/physics_limits.h.
namespace tenon::limits {

inline constexpr std::size_t kModelBodies = 65'000;          ///< bodies, and as many joints
inline constexpr std::size_t kModelGeoms = 100'000;          ///< shapes, pieces of meshes too
inline constexpr std::size_t kModelMeshPoints = 30'000'000;  ///< corners of all their meshes
inline constexpr std::size_t kEnvironments = 1'000'000;      ///< simulations of one scene

/// Pairs of colliders whose boxes overlap at the start, and more for each collider.
inline constexpr std::size_t kStartPairs = 100'000;
inline constexpr std::size_t kStartPairsPerCollider = 30;
inline constexpr std::size_t kOverlapFindings = 10'000;  ///< of colliders that overlap at the start

}  // namespace tenon::limits
