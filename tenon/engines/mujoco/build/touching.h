// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/engines/mujoco/model.h"

/// Contacts of curved shapes that only just touch. MuJoCo finds their normals by an algorithm that
/// loses them within about 1e-11 m of exact touching, and an asset often starts there: a cylinder
/// whose axis is its radius above the floor. Such a contact then pushes aside with the full force
/// of an impact. Without it, the shapes are deeper after one step of gravity, and the normal is
/// good.
namespace tenon::engines::mujoco {

/// Whether a model has shapes with such contacts.
bool has_curved_shapes(const mjModel& model);

/// Leaves the contacts out that are less deep than a thousandth of a free fall of one step. Between
/// mj_collision and mj_makeConstraint. True when there was any.
bool leave_out_touching(const mjModel& model, mjData& data);

}  // namespace tenon::engines::mujoco
