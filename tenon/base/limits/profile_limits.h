// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

/// Limits on what the requirements of a profile look at.
namespace tenon::limits {

inline constexpr std::uint64_t kSidecarBytes = 1u << 22;  ///< of the JSON file beside an asset
inline constexpr std::size_t kSidecarDepth = 8;           ///< objects within objects in it
inline constexpr std::size_t kShadingDepth = 16;  ///< connections of shaders one after another

}  // namespace tenon::limits
