// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tenon::engines::mujoco {

/// What bodies get that have less: MuJoCo refuses moving ones below 1e-15.
inline constexpr double kMinMass = 1e-9;     // [kg]
inline constexpr double kMinMoment = 1e-13;  // [kg m^2]

}  // namespace tenon::engines::mujoco
