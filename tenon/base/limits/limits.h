// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

/// Every limit on what an input may ask for, in one place. Exceeding one is an Error or a
/// diagnostic, never a crash.
namespace tenon::limits {

inline constexpr std::size_t kTextNestingDepth = 1000;    ///< prims, dictionaries, tuples in text
inline constexpr std::size_t kPathElements = 2000;        ///< elements of one path
inline constexpr std::size_t kPathTextLength = 1u << 20;  ///< bytes of one path
inline constexpr std::size_t kLayerStackLayers = 10000;   ///< sublayers of one stage, nested
inline constexpr std::size_t kSublayerDepth = 500;        ///< sublayers of sublayers
inline constexpr std::size_t kIndexNodes = 20000;         ///< nodes of one prim index
inline constexpr std::size_t kCacheNodes = 20'000'000;    ///< nodes of all prim indices of a stage
inline constexpr std::size_t kArcChainDepth = 1000;       ///< arcs from the root to one node
inline constexpr std::size_t kNestedIndices = 100;        ///< indices built within one another
inline constexpr std::size_t kExpressionDepth = 100;      ///< calls and lists of an expression
inline constexpr std::size_t kExpressionWork = 1u << 16;  ///< characters and items by variables
inline constexpr std::size_t kExpressionVariables = 10'000;  ///< variables that are expressions
inline constexpr std::size_t kExpressionNodes = 100'000;    ///< parts of a composed path expression
inline constexpr std::size_t kCollectionVisits = 10'000;    ///< collections read for one
inline constexpr std::size_t kCollectionDepth = 200;        ///< expressions that refer to others
inline constexpr std::size_t kStagePrims = 10'000'000;      ///< composed prims
inline constexpr std::size_t kSplineLoopKnots = 100'000;    ///< knots by an inner loop, each way
inline constexpr std::size_t kSpecFields = 2000;            ///< fields of one spec in text
inline constexpr std::size_t kLayerFindings = 10'000;       ///< warnings about one layer file
inline constexpr std::size_t kTemplateClips = 100'000;      ///< clips of one template
inline constexpr std::size_t kClipTimeSamples = 1'000'000;  ///< times of one attribute in clips
inline constexpr std::size_t kPackageNesting = 8;           ///< packages within packages
inline constexpr std::uint64_t kDecompressionRatio = 300;   ///< bytes out per byte in, at most
inline constexpr std::size_t kKinematicChain = 5000;        ///< bodies on one chain of joints
inline constexpr std::size_t kTrianglePieces = 20000;  ///< triangles taken one by one as colliders
inline constexpr std::size_t kConvexityChecks = 100'000'000;  ///< point-plane tests of one mesh
inline constexpr std::size_t kMeshCorners = 100'000'000;  ///< corners of the faces of a mesh file

// Binary layers: what a file may ask for in proportion to its size.
// What any file may ask for beside that: crate_limits.h.
inline constexpr std::uint64_t kCrateBytesPerRow = 2;      ///< bytes of the file for each row more
inline constexpr std::uint64_t kCrateWorkBase = 1u << 20;  ///< units of work on values of any file
inline constexpr std::uint64_t kCrateWorkPerByte = 2;      ///< units more per byte of the file
inline constexpr std::uint64_t kCrateBytesPerUnit = 32;    ///< bytes of a copied text in a unit
inline constexpr std::size_t kCrateValueDepth = 256;       ///< values within values
inline constexpr std::size_t kArrayEditGrowth = 10'000'000;  ///< elements added by an array edit
inline constexpr std::size_t kTrackSamples = 1'000'000;      ///< poses between authored samples

}  // namespace tenon::limits
