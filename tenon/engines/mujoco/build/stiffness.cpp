// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/build/stiffness.h"

#include <algorithm>
#include <cmath>

#include "tenon/engines/start_coordinates.h"

namespace tenon::engines::mujoco {
namespace {

// Above these a step must be implicit:
constexpr double kStiffSpring = 0.5;  // stiffness dt^2 / inertia
constexpr double kStiffDrive = 1;     // and damping dt / inertia with it
constexpr double kFarInAStep = 0.02;  // [rad or m] with the largest force

bool begins_at_its_largest_force(const scene::PhysicsScene& scene, const Model& model,
                                 const DriveMap& map) {
  const scene::Joint& joint = scene.joints[map.joint];
  const scene::Drive& drive = joint.drives[map.drive];
  Diagnostics silent;
  const scene::JointDofs& dofs = model.joints[map.joint].dofs;
  const std::vector<double> start = start_coordinates(scene, joint, dofs, silent);
  for (std::size_t i = 0; i < dofs.free.size() && i < start.size(); ++i) {
    if (dofs.free[i].dof == drive.dof) {
      return drive.stiffness * std::fabs(drive.target_position - start[i]) > drive.max_force;
    }
  }
  return false;
}

}  // namespace

bool names_integrator(const scene::PhysicsScene& scene) {
  const auto& settings = scene.scenes.front().parts.mujoco;
  return settings && std::any_of(settings->begin(), settings->end(),
                                 [](const auto& each) { return each.name == "option:integrator"; });
}

bool is_stiff_drive(const scene::PhysicsScene& scene, const Model& model, const DriveMap& map,
                    double time_step) {
  const scene::Drive& drive = scene.joints[map.joint].drives[map.drive];
  const double per_inertia = drive.acceleration ? 1 : model.model->dof_invweight0[map.dof];
  const double spring = drive.stiffness * time_step * time_step * per_inertia;
  return spring + drive.damping * time_step * per_inertia > kStiffDrive ||
         (spring > kStiffSpring &&
          drive.max_force * time_step * time_step * per_inertia > kFarInAStep &&
          begins_at_its_largest_force(scene, model, map));
}

std::optional<scene::Index> stiff_spring(const Model& model, double time_step) {
  const mjModel& m = *model.model;
  const double squared_step = time_step * time_step;
  for (scene::Index j = 0; j < model.joints.size(); ++j) {
    std::vector<int> dofs = model.joints[j].dof;
    if (model.joints[j].ball_dof >= 0) {
      dofs.push_back(model.joints[j].ball_dof);
    }
    for (const int dof : dofs) {
      if (m.jnt_stiffness[m.dof_jntid[dof]] * squared_step * m.dof_invweight0[dof] > kStiffSpring) {
        return j;
      }
    }
  }
  return std::nullopt;
}

void report_drives(const scene::PhysicsScene& scene, const Model& model,
                   const std::vector<int>& drives, const DriveFinding& finding,
                   Diagnostics& diagnostics) {
  if (drives.empty()) {
    return;
  }
  const auto joint_of = [&](int drive) {
    return scene.joints[model.drives[static_cast<std::size_t>(drive)].joint].path;
  };
  Message message = finding.message;
  for (std::size_t i = 1; i < drives.size(); ++i) {
    message.about(joint_of(drives[i]), RelatedRole::Joint);
  }
  diagnostics.add({finding.severity, finding.rule, message, joint_of(drives.front()).str(),
                   finding.property, kOwnIntegrator});
}

}  // namespace tenon::engines::mujoco
