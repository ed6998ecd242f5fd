// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/engines/mujoco/model.h"
#include "tenon/scene/physics_scene.h"

/// Which drives and springs are stiff for a step, so that it has to take them where it ends.
namespace tenon::engines::mujoco {

/// The advice of all findings about these choices.
inline constexpr const char* kOwnIntegrator =
    "mjc:option:integrator of MjcSceneAPI on the physics scene wins over this choice";

/// The asset says how steps are made.
bool names_integrator(const scene::PhysicsScene& scene);

/// Whether steps of `time_step` [s] that are implicit in velocity alone are too coarse for a drive
/// of the scene, which acts on `map.dof`: its spring or its damper is stiff against the inertia, so
/// that loops, limits and contacts would have to hold a force of which the damper leaves little, or
/// it begins at its largest force, where the damper does not act, and a step with that goes far.
bool is_stiff_drive(const scene::PhysicsScene& scene, const Model& model, const DriveMap& map,
                    double time_step);

/// The first joint with a spring that is stiff against its inertia and the step [s].
std::optional<scene::Index> stiff_spring(const Model& model, double time_step);

struct DriveFinding {
  Severity severity = Severity::Info;
  std::string rule;
  std::string message;
  std::string property;
};

/// One finding about all of these drives, of Model::drives; none where there are none.
void report_drives(const scene::PhysicsScene& scene, const Model& model,
                   const std::vector<int>& drives, const DriveFinding& finding,
                   Diagnostics& diagnostics);

}  // namespace tenon::engines::mujoco
