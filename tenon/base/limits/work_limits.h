// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

/// How much work a file may ask for, in counts that are the same on every machine. What is linear
/// in the size of the file is paid for by the file; the rest must end soon.
namespace tenon::limits {

inline constexpr std::size_t kComposeWork = 40'000'000;   ///< units of composing any stage
inline constexpr std::size_t kComposeWorkPerSpec = 5000;  ///< the same, more per spec of its layers
inline constexpr std::size_t kInstancedPrims = 1'000'000;   ///< of a walk that enters instances
inline constexpr std::size_t kInstancedPrimsPerSpec = 500;  ///< the same, more per spec of layers
inline constexpr std::size_t kMaterialCopies = 200'000;     ///< prims of materials, one per mesh
inline constexpr std::size_t kMaterialCopiesPerSpec = 3;  ///< the same, more per spec of the asset
inline constexpr std::size_t kTemplateFiles = 400'000;    ///< files that clip templates look for
inline constexpr std::size_t kMatchWork = 100'000'000;    ///< names compared for a path expression
inline constexpr std::size_t kPatternParts = 1'000;  ///< names and stretches of one path pattern
inline constexpr std::size_t kCollectionItems = 1'000'000;  ///< targets read for one collection
inline constexpr std::size_t kStepsPerSecond = 1'000'000;   ///< that a file may ask for

}  // namespace tenon::limits
