// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/physics/physics_scene.h"

namespace tenon {

/// A physics scene as text of MuJoCo's own format (engines/mujoco/write_mjcf.h). ErrorCode::Missing
/// in a build without MuJoCo.
Result<std::string> export_mjcf(const physics::PhysicsScene& scene, Diagnostics& diagnostics);

}  // namespace tenon
