// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "tenon/scene/timeline/timeline.h"

namespace tenon::engines {

/// What bodies get that have less: engines refuse moving ones without mass, or take them for
/// infinitely heavy.
inline constexpr double kMinMass = 1e-9;     // [kg]
inline constexpr double kMinMoment = 1e-13;  // [kg m^2]

/// Where a model begins: at the start of a scene, whose links of articulations have no velocities
/// of their own (S-32), or in the middle of a run.
enum class Begin : std::uint8_t {
  Start,   ///< at the start of a run
  Middle,  ///< in it: the bodies' poses and velocities are those of the run
};

/// A timeline whose merged bodies get what engines still move.
std::unique_ptr<scene::Timeline> timeline_of(const scene::PhysicsScene& scene);
/// The same where the scene needs one, else null.
std::unique_ptr<scene::Timeline> timeline_where_needed(const scene::PhysicsScene& scene);

}  // namespace tenon::engines
