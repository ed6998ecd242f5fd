// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/engines/simulation_values.h"

/// Settings of one vendor's engine, which the others report: none is ignored silently.
namespace tenon::engines {

/// Of PhysX's solver, for engines that are not PhysX.
void report_physx_settings(const scene::PhysicsScene& scene, std::vector<NotMapped>& list);

/// Of MuJoCo's solver and contacts, for engines that are not MuJoCo; of its actuators and tendons
/// they speak themselves.
void report_mujoco_settings(const scene::PhysicsScene& scene, std::vector<NotMapped>& list);

}  // namespace tenon::engines
