// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Linked into the program alone: in a library it would reach the MuJoCo of others in the process.
#include "tenon/engines/mujoco/set_up/set_const_groups.h"

// MuJoCo's compiler finds this one before its own.
extern "C" __attribute__((visibility("default"))) void mj_setConstGroups(mjModel* model,
                                                                         mjData* data, int groups) {
  tenon::engines::mujoco::set_const_groups(model, data, groups);
}

extern "C" void tenon_sets_up_mujoco();
void tenon_sets_up_mujoco() {}
