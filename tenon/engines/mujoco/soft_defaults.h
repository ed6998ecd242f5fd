// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "tenon/engines/mujoco/mujoco_library.h"

/// What MuJoCo takes for the softness of constraints where MJCF says nothing.
namespace tenon::engines::mujoco {

inline constexpr std::array<double, mjNREF> kSolref{0.02, 1};
inline constexpr std::array<double, mjNIMP> kSolimp{0.9, 0.95, 0.001, 0.5, 2};

}  // namespace tenon::engines::mujoco
