// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

/// Limits on named poses and inverse kinematics.
namespace tenon::limits {

inline constexpr std::size_t kReachStarts = 10'000;        ///< postures that a search begins from
inline constexpr std::size_t kReachTargets = 100;          ///< frames of one search
inline constexpr std::size_t kNamedPoses = 10'000;         ///< of an asset
inline constexpr std::size_t kImportedPoses = 2'000;       ///< of a file, each written as a prim
inline constexpr std::size_t kPoseValues = 100'000;        ///< joints of one named pose
inline constexpr std::size_t kPoseFileBytes = 67'108'864;  ///< of a file of poses

}  // namespace tenon::limits
