// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mujoco/mjspecmacro.h>
#include <mujoco/mujoco.h>

#include "tenon/base/result.h"

/// MuJoCo's library, opened when it is first asked for: who only reads or checks assets neither
/// waits for it nor needs it.
namespace tenon {

// MuJoCo's functions under their own names, to be called once open_mujoco() was successful.
#define TENON_MUJOCO_FUNCTION(name) extern decltype(&::name) name;
#include "tenon/engines/mujoco/mujoco_functions.def"
#undef TENON_MUJOCO_FUNCTION

}  // namespace tenon

namespace tenon::engines::mujoco {

/// Opens the library: the one that the loader finds by the name it had when this was built (beside
/// the program), else the one that this was built with. Threads may call it at the same time; later
/// calls cost nothing. Errors: Missing (rule engine.missing) when there is none, or another
/// version.
Result<void> open_mujoco();

/// Whether MuJoCo's compiler calls set_const_groups() in the place of its own. Not where the
/// library was open before: then it is another's, too. After open_mujoco() was successful.
bool sets_up_by_ours();

/// A function that is not in the table, because the program is to have no way to it; nullptr: none.
/// After open_mujoco() was successful.
void* find_mujoco_function(const char* name);

/// The callback that decides about pairs of geoms, one for the whole process (mjcb_contactfilter).
mjfConFilt& contact_filter_callback();
/// The callback between what positions and velocities give and the forces of actuators, one for the
/// whole process (mjcb_control).
mjfGeneric& control_callback();

}  // namespace tenon::engines::mujoco
