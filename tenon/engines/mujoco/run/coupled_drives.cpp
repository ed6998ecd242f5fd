// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/run/coupled_drives.h"

#include <cstddef>

namespace tenon::engines::mujoco {
namespace {

constexpr int kSwitchedOff = 30;     // group of actuators that exert nothing by themselves
constexpr double kUnbounded = 1e10;  // the largest number that MuJoCo takes

/// Calls `act` with each drive that has a constraint and the number of that: trees that sleep have
/// none.
template <class Act>
void for_each_row(const Model& model, const Act& act) {
  const mjData& d = *model.data;
  for (int i = d.ne; i < d.ne + d.nf && !model.drive_of_tendon.empty(); ++i) {
    const int drive = d.efc_type[i] == mjCNSTR_FRICTION_TENDON
                          ? model.drive_of_tendon[static_cast<std::size_t>(d.efc_id[i])]
                          : -1;
    if (drive >= 0) {
      act(model.drives[static_cast<std::size_t>(drive)], i);
    }
  }
}

struct Row {
  double acceleration = 0;  ///< that is wanted
  double mass = 0;          ///< force by what it differs
  double most = 0;          ///< force
};

Row row_for(const DriveMap& map, const mjModel& m, const mjData& d) {
  const double* gains = m.actuator_biasprm + std::ptrdiff_t{mjNBIAS} * map.actuator;
  const double stiffness = -gains[1];
  const double damping = -gains[2];
  const double dt = m.opt.timestep;
  const double velocity = d.qvel[map.dof];
  const double slope = damping + stiffness * dt;
  if (!(slope > 0)) {
    return {0, mjMINVAL, 0};
  }
  const double position = d.qpos[m.jnt_qposadr[m.dof_jntid[map.dof]]];
  const double force =
      stiffness * (d.ctrl[map.control] - position) + damping * d.ctrl[map.control + 1];
  const bool limited = m.actuator_forcelimited[map.actuator] != 0;
  return {(force / slope - velocity) / dt, slope * dt,
          limited ? m.actuator_forcerange[2 * map.actuator + 1] : kUnbounded};
}

}  // namespace

void couple_drive(const DriveMap& drive, mjModel& model) {
  model.actuator_group[drive.actuator] = kSwitchedOff;
  model.opt.disableactuator |= 1 << kSwitchedOff;
  model.tendon_frictionloss[drive.tendon] = kUnbounded;
}

void write_coupled_drives(const Model& model) {
  mjData& d = *model.data;
  for_each_row(model, [&](const DriveMap& map, int at) {
    const Row row = row_for(map, *model.model, d);
    d.efc_D[at] = row.mass;
    d.efc_R[at] = 1 / row.mass;
    d.efc_frictionloss[at] = row.most;
    d.efc_aref[at] = row.acceleration;
    if (d.nisland > 0) {  // what the solver reads of islands was copied before
      const int copy = d.map_efc2iefc[at];
      d.iefc_D[copy] = row.mass;
      d.iefc_R[copy] = 1 / row.mass;
      d.iefc_frictionloss[copy] = row.most;
    }
  });
}

// What reads forces later finds a drive among the actuators, not among the constraints.
void read_coupled_drives(const Model& model) {
  mjData& d = *model.data;
  for_each_row(model, [&](const DriveMap& map, int at) {
    const double force = d.efc_force[at];
    d.actuator_force[map.actuator] = force;
    d.qfrc_actuator[map.dof] += force;
    d.qfrc_smooth[map.dof] += force;
    d.qfrc_constraint[map.dof] -= force;
  });
}

void forward(const Model& model) {
  mjModel* m = model.model.get();
  mjData* d = model.data.get();
  if (model.drive_of_tendon.empty()) {
    mj_forward(m, d);
    return;
  }
  mj_step1(m, d);
  write_coupled_drives(model);
  mj_fwdActuation(m, d);
  mj_fwdAcceleration(m, d);
  mj_fwdConstraint(m, d);
  read_coupled_drives(model);
}

}  // namespace tenon::engines::mujoco
