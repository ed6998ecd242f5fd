// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/physics/scene_names.h"
#include "tenon/scene/mujoco_actuators.h"
#include "tenon/stage/stage.h"

namespace tenon::physics {

/// All MjcActuator and MjcKeyframe prims that are active, loaded, defined and no classes. `scene`
/// is what was read from the same stage. Prims in prototypes of point instancers are not looked at.
MujocoParts read_mujoco_parts(const stage::Stage& stage, const PhysicsScene& scene);

}  // namespace tenon::physics
