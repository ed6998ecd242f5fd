// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "tenon/scene/timeline/timeline.h"

namespace tenon::engines {

/// What bodies get that have less: engines refuse moving ones without mass, or take them for
/// infinitely heavy.
inline constexpr double kMinMass = 1e-9;     // [kg]
inline constexpr double kMinMoment = 1e-13;  // [kg m^2]

/// A timeline whose merged bodies get what engines still move.
std::unique_ptr<scene::Timeline> timeline_of(const scene::PhysicsScene& scene);
/// The same where the scene needs one, else null.
std::unique_ptr<scene::Timeline> timeline_where_needed(const scene::PhysicsScene& scene);

}  // namespace tenon::engines
