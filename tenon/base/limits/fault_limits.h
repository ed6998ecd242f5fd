// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace tenon::limits {

inline constexpr std::size_t kTextFaults = 20;         ///< faults told about a text layer
inline constexpr std::size_t kStageFindings = 10'000;  ///< of composing a stage
inline constexpr std::size_t kRelatedPrims = 100;      ///< prims that one finding names

/// Bytes that are looked at again, to find the items that findings of one text layer are about.
inline constexpr std::size_t kPlaceWorkPerByte = 8;
inline constexpr std::size_t kPlaceWork = 16'777'216;  ///< the least of the same

}  // namespace tenon::limits
