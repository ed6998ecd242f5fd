// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

/// Every limit on what an input may ask for, in one place. Exceeding one is an Error or a
/// diagnostic, never a crash.
namespace tenon::limits {

inline constexpr std::size_t kTextNestingDepth = 1000;      ///< prims, dictionaries, tuples in text
inline constexpr std::size_t kPathElements = 2000;          ///< elements of one path
inline constexpr std::size_t kPathTextLength = 1u << 20;    ///< bytes of one path
inline constexpr std::size_t kLayerStackLayers = 10000;     ///< sublayers of one stage, nested
inline constexpr std::size_t kIndexNodes = 100000;          ///< nodes of one prim index
inline constexpr std::size_t kArcChainDepth = 1000;         ///< arcs from the root to one node
inline constexpr std::size_t kStagePrims = 50'000'000;      ///< composed prims
inline constexpr std::size_t kPackageNesting = 8;           ///< packages within packages
inline constexpr std::uint64_t kDecompressionRatio = 300;   ///< bytes out per byte in, at most

}  // namespace tenon::limits
