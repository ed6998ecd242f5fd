// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/function.h"
#include "tenon/engines/mujoco/model.h"

namespace tenon::engines::mujoco {

/// A step of the classical method of Runge and Kutta by four calls of `positions`, which brings
/// what follows from positions and velocities up to date, contacts included. MuJoCo's own method
/// takes contacts as they are made.
void step_runge_kutta(Model& model, const Function<void()>& positions);

}  // namespace tenon::engines::mujoco
