// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A step writes what the asset says about its time (Timeline, StepInputs), lets MuJoCo advance, and
// breaks joints that carried too much. Bounds and gravity MuJoCo takes as they come; for other
// changes of the scene the model is made anew from the scene as it is now, and poses, velocities
// and joint coordinates go over (S-28). What is read comes from the positions after the last step,
// from which MuJoCo derives poses and velocities only when something is read.
#include "tenon/engines/mujoco/mujoco_simulation.h"

#include <cstdio>
#include <string>
#include <utility>

#include "tenon/engines/mujoco/build/build.h"
#include "tenon/engines/mujoco/build/min_inertia.h"
#include "tenon/engines/mujoco/build/surfaces.h"
#include "tenon/engines/mujoco/contact_filter.h"
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/mujoco/run/carry_over.h"
#include "tenon/engines/mujoco/run/read_state.h"

namespace tenon::engines::mujoco {
namespace {

using scene::PhysicsScene;

/// What MuJoCo still moves.
scene::BodyMass min_mass() {
  scene::BodyMass least;
  least.mass = kMinMass;
  least.inertia = {};
  for (std::size_t i = 0; i < 3; ++i) {
    least.inertia[i][i] = kMinMoment;
  }
  return least;
}

}  // namespace

Result<std::unique_ptr<MujocoSimulation>> MujocoSimulation::make(const PhysicsScene& scene,
                                                                 const SimulationOptions& options,
                                                                 Diagnostics& diagnostics) {
  auto timeline = scene::Timeline::is_needed(scene)
                      ? std::make_unique<scene::Timeline>(scene, min_mass())
                      : nullptr;
  const PhysicsScene& now = timeline == nullptr ? scene : timeline->scene();
  TENON_TRY(Model model, build_model(now, options, diagnostics));
  return std::unique_ptr<MujocoSimulation>(
      new MujocoSimulation(scene, std::move(timeline), std::move(model)));
}

MujocoSimulation::MujocoSimulation(const PhysicsScene& scene,
                                   std::unique_ptr<scene::Timeline> timeline, Model model)
    : timeline_(std::move(timeline)),
      scene_(timeline_ == nullptr ? &scene : &timeline_->scene()),
      model_(std::move(model)),
      not_mapped_(model_.not_mapped) {
  connect();
}

// What the simulation remembers about the model that it steps.
void MujocoSimulation::connect() {
  inputs_ = StepInputs(*scene_, model_);
  if (timeline_ != nullptr) {
    bounds_ = MovingBounds(*scene_, model_);
    breaking_ = Breaking(*scene_, model_);
  }
  stale_ = true;
}

Result<void> MujocoSimulation::step() {
  if (timeline_ != nullptr) {
    TENON_CHECK(follow_changes());
  }
  if (inputs_.needs_motion()) {
    bring_up_to_date();
  }
  inputs_.before_step(model_);
  stale_ = true;
  {
    const FilterScope filter(model_.filter);
    TENON_CHECK(guarded([this] { advance(); }));
  }
  TENON_CHECK(check());
  inputs_.after_step(model_);
  return breaking_.empty() ? Result<void>() : break_joints();
}

Result<void> MujocoSimulation::follow_changes() {
  const scene::SceneChange change = timeline_->advance(time());
  if (change.gravity) {
    write_vector(model_.model->opt.gravity, scene_->scenes.front().gravity);
    set_other_gravities(*scene_, model_);
    inputs_.take_constant_forces(model_);
  }
  const bool fits = !change.bounds || bounds_.write(*scene_, model_);
  return change.structure || !fits ? rebuild() : Result<void>();
}

Result<void> MujocoSimulation::rebuild() {
  std::vector<BodyState> states;
  for (std::size_t b = 0; b < scene_->bodies.size(); ++b) {
    states.push_back(body_state(static_cast<scene::Index>(b)));
  }
  const std::vector<scene::MergedBody> joined = timeline_->restart(states);
  Diagnostics silent;  // what there is to say was said at the start
  TENON_TRY(Model next, build_model(*scene_, {.time_step = time_step()}, silent, Begin::Middle));
  carry_joints_over(model_, next);
  next.data->time = model_.data->time;
  model_ = std::move(next);
  connect();
  const FilterScope filter(model_.filter);
  return guarded([&] {
    mj_forward(model_.model.get(), model_.data.get());
    for (const scene::MergedBody& part : joined) {
      join_momentum(scene_->bodies[part.body], model_.bodies[part.body], model_);
    }
    if (!joined.empty()) {
      mj_forward(model_.model.get(), model_.data.get());
    }
  });
}

Result<void> MujocoSimulation::break_joints() {
  TENON_TRY(const std::vector<Breaking::Broken> broken, breaking_.broken(*scene_, model_));
  for (const Breaking::Broken& part : broken) {
    char what[96];
    std::snprintf(what, sizeof what, "broke under %.4g N and %.4g N m", length(part.load.force),
                  length(part.load.torque));
    events_.push_back({time(), scene_->joints[part.joint].path, what});
    timeline_->break_joint(part.joint);
  }
  return broken.empty() ? Result<void>() : rebuild();
}

// Pair averages of friction and restitution are written between the making of contacts and that of
// constraints, which are then made again; without them this is one mj_step.
void MujocoSimulation::advance() {
  const mjModel* m = model_.model.get();
  mjData* d = model_.data.get();
  if (model_.surfaces.kinds.size() <= 1) {
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

void MujocoSimulation::bring_up_to_date() const {
  if (stale_) {
    derive_motion(model_);
    stale_ = false;
  }
}

double MujocoSimulation::time() const { return model_.data->time; }
double MujocoSimulation::time_step() const { return model_.model->opt.timestep; }
std::size_t MujocoSimulation::dof_count() const {
  return static_cast<std::size_t>(model_.model->nv);
}
std::size_t MujocoSimulation::contact_count() const { return read_contact_count(model_); }

BodyState MujocoSimulation::body_state(scene::Index body) const {
  bring_up_to_date();
  return read_body_state(*scene_, model_, body);
}

JointState MujocoSimulation::joint_state(scene::Index joint) const {
  if (!model_.joints[joint].in_tree) {
    bring_up_to_date();
  }
  return read_joint_state(*scene_, model_, joint);
}

Energy MujocoSimulation::energy() const {
  bring_up_to_date();
  return read_energy(*scene_, model_);
}

}  // namespace tenon::engines::mujoco
