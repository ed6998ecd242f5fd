// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/engines/mujoco/mujoco_library.h"

namespace tenon::engines::mujoco {

/// Takes the place of MuJoCo's own function of this purpose, mj_setConstGroups, in the calls of its
/// compiler (sets_up_by_ours()): large models are compiled in time that grows with the number of
/// bodies (10,000 free bodies: a fifteenth). Small models, other versions of MuJoCo and models with
/// what set_inverse_weights leaves alone get MuJoCo's own.
/// `groups`: bits of what to compute, in the order of the columns of MJSETCONST_ARRAYS.
void set_const_groups(mjModel* model, mjData* data, int groups);

/// EngineInfo::set_up_per_pair, with or without this in its place.
double set_up_per_pair();

}  // namespace tenon::engines::mujoco
