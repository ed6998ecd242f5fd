// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/result.h"
#include "tenon/engines/mujoco/model.h"

namespace tenon::engines::mujoco {

/// One step of MuJoCo, with the friction of pairs of materials.
void advance(Model& model);

/// What MuJoCo warned of in a step: a state that is no number (mujoco.unstable), too many contacts
/// (mujoco.contacts-full).
Result<void> check_step(const Model& model);

}  // namespace tenon::engines::mujoco
