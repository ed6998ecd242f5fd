// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "tenon/asset/drives/motor_specs.h"
#include "tenon/base/result.h"
#include "tenon/dynamics/multibody.h"
#include "tenon/stage/stage.h"

/// Internal to the drives of assets.
namespace tenon {

/// What a data sheet makes of a drive. [N m or N, rad/s or m/s]
struct SpecLimits {
  std::optional<double> effort;
  std::optional<double> speed;
};

/// Errors: Invalid (drives.specs), NotFound (drives.no-tip), both with the file and line of `spec`.
Result<SpecLimits> limits_of(const MotorSpec& spec, const std::string& file,
                             const stage::Stage& stage, const scene::PhysicsScene& scene,
                             const scene::Joint& joint, scene::Dof dof);

}  // namespace tenon
