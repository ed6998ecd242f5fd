// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mjcf/keyframes.h"

#include <algorithm>
#include <utility>

namespace tenon::mjcf {

using robot::Index;

namespace {

std::vector<double> controls_of(const mjModel& model, const Actuators& actuators,
                                const std::vector<robot::Joint>& joints, int key) {
  const double* controls =
      model.key_ctrl + static_cast<std::size_t>(key) * static_cast<std::size_t>(model.nu);
  std::vector<std::pair<Index, double>> of_drives;
  for (std::size_t i = 0; i < actuators.drives.size(); ++i) {
    const std::optional<JointDrive>& drive = actuators.drives[i];
    if (drive && !joints[drive->joint].mimic) {
      of_drives.emplace_back(drive->joint, drive->asked_for(controls[model.actuator_ctrladr[i]]));
    }
  }
  std::sort(of_drives.begin(), of_drives.end());
  std::vector<double> ordered;
  for (const auto& [joint, control] : of_drives) {
    ordered.push_back(control);
  }
  for (const int motor : actuators.motor_numbers) {
    ordered.push_back(controls[model.actuator_ctrladr[motor]]);
  }
  return ordered;
}

/// Of the actuators that are there.
std::vector<double> activations_of(const mjModel& model, const Actuators& actuators, int key) {
  const double* row =
      model.key_act + static_cast<std::size_t>(key) * static_cast<std::size_t>(model.na);
  std::vector<double> result;
  for (const int motor : actuators.motor_numbers) {
    const int count = model.actuator_actnum[motor];
    for (int i = 0; i < count; ++i) {
      result.push_back(row[model.actuator_actadr[motor] + i]);
    }
  }
  return result;
}

/// The coordinates (nq) of a keyframe.
std::vector<double> positions_of(const mjModel& model, int key) {
  const auto size = static_cast<std::size_t>(model.nq);
  const double* row = model.key_qpos + size * static_cast<std::size_t>(key);
  std::vector<double> positions(row, row + size);
  for (int joint = 0; joint < model.njnt; ++joint) {
    const int type = model.jnt_type[joint];
    const auto coordinate = static_cast<std::size_t>(model.jnt_qposadr[joint]);
    if (type == mjJNT_HINGE || type == mjJNT_SLIDE) {
      positions[coordinate] -= model.qpos0[coordinate];
    }
  }
  return positions;
}

}  // namespace

std::vector<robot::MujocoKeyframe> read_keyframes(MjcfSource& source, const Actuators& actuators,
                                                  const std::vector<robot::Joint>& joints) {
  const mjModel& model = source.model();
  std::vector<robot::MujocoKeyframe> frames;
  for (int key = 0; key < model.nkey; ++key) {
    robot::MujocoKeyframe& frame = frames.emplace_back();
    frame.name = source.name(mjOBJ_KEY, key, "keyframe");
    frame.positions = positions_of(model, key);
    const auto size = static_cast<std::size_t>(model.nv);
    const double* velocities = model.key_qvel + size * static_cast<std::size_t>(key);
    frame.velocities.assign(velocities, velocities + size);
    frame.activations = activations_of(model, actuators, key);
    frame.controls = controls_of(model, actuators, joints, key);
    if (model.key_time[key] != 0) {
      source.left_out("the time of keyframe \"" + frame.name + "\" is skipped");
    }
  }
  return frames;
}

}  // namespace tenon::mjcf
