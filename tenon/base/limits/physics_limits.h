// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

/// Limits that only physics asks for, beside those of tenon/base/limits/limits.h.
namespace tenon::limits {

inline constexpr std::size_t kPointInstances = 250'000;    ///< instances with physics of a stage
inline constexpr std::size_t kInstancedPhysics = 150'000;  ///< prims with physics by instances
/// The same by references that are instanceable, and more per spec of the stage's layers.
inline constexpr std::size_t kInstancedPhysicsBase = 20'000;
inline constexpr std::size_t kInstancedPhysicsPerSpec = 20;
inline constexpr std::size_t kPointInstancerDepth = 8;        ///< point instancers in one another
inline constexpr std::size_t kDecomposedTriangles = 200'000;  ///< of a mesh that is decomposed
inline constexpr std::size_t kShapeSamples = 4'000;           ///< of shapes that move inside a body
inline constexpr std::size_t kObjectReadings = 500'000;       ///< prims read again, of all samples
inline constexpr std::size_t kHullPoints = 10'000;            ///< corners of a hull
inline constexpr std::size_t kSensorWidth = 10'000;           ///< measurements in a sensor's mean
inline constexpr std::size_t kSensorRays = 1'000'000;         ///< of all sensors of a robot
inline constexpr std::size_t kNestingStates = 1'000;          ///< of bodies switched off in others
inline constexpr std::size_t kSetsOfCollider = 256;     ///< of filters that one collider is in
inline constexpr std::size_t kCollisionGroups = 4'096;  ///< of a stage
/// Targets of collections that are read for all of them, a collection for 20.
inline constexpr std::size_t kCollisionGroupWork = 2'000'000;
inline constexpr std::size_t kDisabledPairs = 1'000'000;      ///< of colliders, that are listed
inline constexpr std::size_t kDisabledPairWork = 50'000'000;  ///< colliders looked at for them
inline constexpr std::size_t kDenseCoordinates = 1'000;       ///< of bodies that hang together
inline constexpr std::size_t kDenseWork = 2'000'000'000;      ///< multiplications for inertias
inline constexpr std::size_t kLoopWork = 50'000'000;          ///< for a step that closes loops

}  // namespace tenon::limits
