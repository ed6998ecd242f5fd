// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

/// Limits on the search for pairs of bodies that touch.
namespace tenon::limits {

inline constexpr std::size_t kPairPostures = 1'000'000;    ///< that are drawn
inline constexpr std::size_t kListedPairs = 250'000;       ///< of bodies, and of a file of pairs
inline constexpr std::size_t kPairFileBytes = 67'108'864;  ///< of a file of pairs
inline constexpr std::size_t kPostureValues = 500'000;     ///< joints of postures of listed pairs

}  // namespace tenon::limits
