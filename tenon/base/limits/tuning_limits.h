// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

/// Limits on the search of gains.
namespace tenon::limits {

/// Payloads times poses times engines: a simulation is kept for each.
inline constexpr std::size_t kSearchScenes = 64;
inline constexpr std::size_t kDrawnForPoses = 10'000;  ///< postures, until enough are possible

}  // namespace tenon::limits
