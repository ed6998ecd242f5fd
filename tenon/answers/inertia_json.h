// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tenon/answers/json.h"
#include "tenon/base/result.h"
#include "tenon/dynamics/dynamics.h"

namespace tenon::answers {

enum class WithMatrix : std::uint8_t { No, Yes };

/// What joints have to move at a posture: {"mass" [kg], "centerOfMass" (3) [m, world], "loopGap"
/// [m], "coordinates", "massMatrix" where wanted (dof_count x dof_count, a list of rows)}. A
/// coordinate is {"joint", null of a floating body; "body"; "dof"; "position" [m, rad], null of a
/// floating body; "held", "free": EffectiveInertia [kg, kg m^2], null where it cannot move or is
/// not known; "gravity": what gravity exerts along it [N, N m]; "armature"} (dof_count). Errors:
/// those of Dynamics::mass_matrix.
Result<Json> inertia_json(const dynamics::Multibody& multibody, const dynamics::Dynamics& dynamics,
                          WithMatrix matrix);

}  // namespace tenon::answers
