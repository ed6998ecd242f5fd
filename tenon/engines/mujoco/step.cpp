// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <string>

#include "tenon/engines/mujoco/contact_filter.h"
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/mujoco/mujoco_simulation.h"
#include "tenon/engines/mujoco/surfaces.h"

namespace tenon::engines::mujoco {

MujocoSimulation::MujocoSimulation(const physics::PhysicsScene& scene,
                                   std::unique_ptr<physics::PhysicsScene> own, BodyNesting nesting,
                                   Model model)
    : scene_(own == nullptr ? &scene : own.get()),
      own_(std::move(own)),
      nesting_(std::move(nesting)),
      model_(std::move(model)),
      not_mapped_(model_.not_mapped),
      broken_(scene.joints.size(), 0) {
  connect();
}

// What the simulation remembers about the model that it steps.
void MujocoSimulation::connect() {
  drives_.clear();
  acceleration_drives_.clear();
  tracked_drives_.clear();
  driven_bodies_.clear();
  moved_colliders_.clear();
  damped_bodies_.clear();
  for (std::size_t i = 0; i < model_.drives.size(); ++i) {
    const DriveMap& map = model_.drives[i];
    drives_.push_back(scene_->joints[map.joint].drives[map.drive]);
    if (map.actuator >= 0 && drives_.back().acceleration) {
      acceleration_drives_.push_back(i);
    }
  }
  unit_.assign(static_cast<std::size_t>(model_.model->nv), 0);
  response_ = unit_;
  collect_tracks();
  collect_damped_bodies();
  start_driven_bodies();
  collect_changes();
  collect_breakable();
  writes_before_step_ = !tracked_drives_.empty() || !driven_bodies_.empty() ||
                        !moved_colliders_.empty() || !damped_bodies_.empty() ||
                        !acceleration_drives_.empty();
  stale_ = true;
}

Result<void> MujocoSimulation::step() {
  if (own_ != nullptr) {
    TENON_CHECK(follow_changes());
  }
  if (writes_before_step_) {
    follow_drive_tracks();
    scale_acceleration_drives();
    move_colliders();
    damp_bodies();
    push_driven_bodies();
  }
  stale_ = true;
  {
    const FilterScope filter(model_.filter);
    TENON_CHECK(guarded([this] { advance(); }));
  }
  TENON_CHECK(check());
  if (!driven_bodies_.empty()) {
    place_driven_bodies();
  }
  return breakable_.empty() ? Result<void>() : break_joints();
}

// Pair averages of friction and restitution are written between the making of contacts and that of
// constraints, which are then made again; without them this is one mj_step.
void MujocoSimulation::advance() {
  const mjModel* m = model_.model.get();
  mjData* d = model_.data.get();
  if (!model_.surfaces.differ) {
    mj_step(m, d);
    return;
  }
  mj_step1(m, d);
  if (apply_surfaces(model_.surfaces, d)) {
    mj_makeConstraint(m, d);
    mj_island(m, d);
    mj_projectConstraint(m, d);
    mj_referenceConstraint(m, d);
  }
  mj_step2(m, d);
}

Result<void> MujocoSimulation::check() const {
  const mjData& d = *model_.data;
  for (const int warning : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC}) {
    if (d.warning[warning].number > 0) {
      return unstable(warning);
    }
  }
  if (d.warning[mjWARN_CONTACTFULL].number > 0 || d.warning[mjWARN_CNSTRFULL].number > 0) {
    return Error(ErrorCode::Limit, "MuJoCo has no room for the " + std::to_string(d.ncon) +
                                       " contacts at " + std::to_string(d.time) + " s")
        .with_rule("mujoco.contacts-full");
  }
  return {};
}

Error MujocoSimulation::unstable(int warning) const {
  const mjModel& m = *model_.model;
  const mjData& d = *model_.data;
  int dof = d.warning[warning].lastinfo;
  int body = 0;
  if (warning == mjWARN_BADQPOS) {
    for (int j = 0; j < m.njnt && m.jnt_qposadr[j] <= dof; ++j) {
      body = m.jnt_bodyid[j];
    }
  } else if (dof >= 0 && dof < m.nv) {
    body = m.dof_bodyid[dof];
  }
  const char* name = mj_id2name(&m, mjOBJ_BODY, body);
  char text[160];
  std::snprintf(text, sizeof(text), "the simulation became unstable at %.6g s", d.time);
  return Error(ErrorCode::Unstable, text)
      .with_rule("mujoco.unstable")
      .with_prim(name == nullptr ? "" : name)
      .with_fix("use a smaller time step, softer drives, or more armature");
}

}  // namespace tenon::engines::mujoco
