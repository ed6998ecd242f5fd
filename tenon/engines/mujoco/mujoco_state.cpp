// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A state is what MuJoCo calls the state of integration, and all that another process needs for the
// same model: the values that the user has set, and each time that the model was rebuilt, with the
// bodies as they were then. The model itself is not in it; it follows from the scene. Restoring
// builds a second simulation and takes its place only when all went well. Everything in the bytes
// is checked before MuJoCo sees it.
#include <algorithm>
#include <cmath>

#include "tenon/base/wire.h"
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/mujoco/mujoco_simulation.h"
#include "tenon/engines/mujoco/run/advance.h"
#include "tenon/engines/mujoco/run/carry_over.h"
#include "tenon/engines/scene_timeline.h"
#include "tenon/scene/fields/wire_form.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Index;

bool all_finite(const std::vector<double>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

bool is_finite_state(const BodyState& state) {
  return is_usable(state.pose) && is_finite(state.linear_velocity) &&
         is_finite(state.angular_velocity);
}

// With which numbers the next step finds the inertia that acceleration drives look at.
std::vector<double> factor_of(const mjModel& m, const mjData& d) {
  std::vector<double> factor(d.qLD, d.qLD + m.nC);
  factor.insert(factor.end(), d.qLDiagInv, d.qLDiagInv + m.nv);
  return factor;
}

void write_factor(const std::vector<double>& factor, const mjModel& m, mjData& d) {
  std::copy_n(factor.begin(), m.nC, d.qLD);
  std::copy_n(factor.begin() + m.nC, m.nv, d.qLDiagInv);
}

Result<void> check_restart(const Restart& restart, const scene::PhysicsScene& scene) {
  bool sound = std::isfinite(restart.time) && std::isfinite(restart.advanced_to) &&
               restart.states.size() == scene.bodies.size() &&
               std::all_of(restart.states.begin(), restart.states.end(), is_finite_state);
  for (const BrokenJoint& part : restart.broken) {
    sound = sound && part.joint < scene.joints.size();
  }
  for (const Index body : restart.driven) {
    sound = sound && body < scene.bodies.size() && scene.bodies[body].kinematic;
  }
  return sound ? Result<void>() : bad_state("a restart cannot be");
}

}  // namespace

std::uint64_t MujocoSimulation::Start::scene_hash() const { return scene::scene_hash(*scene); }

StateOwner MujocoSimulation::owner() const {
  return {"mujoco", mj_versionString(), start_->scene_hash(), time_step()};
}

Result<std::unique_ptr<MujocoSimulation>> MujocoSimulation::another() const {
  return from_start(start_, nullptr);
}

Result<void> MujocoSimulation::reset() {
  DataPtr data = history_.empty() ? std::move(model_.data) : nullptr;
  TENON_TRY(std::unique_ptr<MujocoSimulation> fresh, from_start(start_, std::move(data)));
  *this = std::move(*fresh);
  return {};
}

Result<std::string> MujocoSimulation::save_state() const {
  SavedRun run;
  run.drives = start_->options.drives;
  run.methods = start_->options.methods;
  run.advanced_to = advanced_to_;
  run.history = history_;
  run.steering = steering_;
  run.state = integration_state(*model_.model, *model_.data);
  run.asleep = sleeping_trees(*model_.model, *model_.data);
  if (inputs_.has_acceleration_drives()) {
    run.factor = factor_of(*model_.model, *model_.data);
  }
  if (outputs_) {
    run.work = outputs_->work;
  }
  return seal_state(owner(), wire::encoded(run));
}

Result<void> MujocoSimulation::restore_state(std::string_view bytes) {
  TENON_TRY(const std::string body, open_state(owner(), bytes));
  const std::optional<SavedRun> run = wire::decoded<SavedRun>(body);
  if (!run) {
    return bad_state("its parts do not fit together");
  }
  if (run->drives != start_->options.drives) {
    return Error(ErrorCode::Unsupported, "the saved state is of other SimulationOptions::drives")
        .with_rule("simulation.state");
  }
  if (run->methods != start_->options.methods) {
    return Error(ErrorCode::Unsupported, "the saved state is of other SimulationOptions::methods")
        .with_rule("simulation.state");
  }
  TENON_TRY(std::unique_ptr<MujocoSimulation> fresh, from_start(start_, nullptr));
  TENON_CHECK(fresh->replay(*run));
  TENON_CHECK(fresh->check_run(*run));
  fresh->steering_ = run->steering;
  TENON_CHECK(fresh->apply_steering());
  TENON_CHECK(write_state(fresh->model_, run->state, run->asleep));
  if (fresh->inputs_.has_acceleration_drives()) {
    write_factor(run->factor, *fresh->model_.model, *fresh->model_.data);
  }
  TENON_CHECK(check_step(fresh->model_));
  if (fresh->outputs_) {
    fresh->outputs_->work = run->work;
    TENON_CHECK(fresh->outputs_->at_rest(*fresh->scene_, fresh->model_));
  }
  fresh->stale_ = true;
  if (!fresh->triggers_.empty()) {  // what is inside is no news
    fresh->bring_up_to_date();
    fresh->triggers_.update(*fresh->scene_, fresh->model_, nullptr);
  }
  *this = std::move(*fresh);
  return {};
}

// The timeline goes through all restarts; only the last one needs its model.
Result<void> MujocoSimulation::replay(const SavedRun& run) {
  if (!std::isfinite(run.advanced_to)) {
    return bad_state("its time is none");
  }
  if (!run.history.empty() && timeline_ == nullptr) {
    timeline_ = timeline_of(*start_->scene);
    scene_ = &timeline_->scene();
  }
  for (const Restart& restart : run.history) {
    if (restart.advanced_to >= 0) {
      timeline_->advance(restart.advanced_to);
    }
    TENON_CHECK(check_restart(restart, *scene_));
    note_broken(restart);
    for (const Index body : restart.driven) {
      timeline_->hold_pose(body);
    }
    timeline_->restart(restart.states);
    history_.push_back(restart);
  }
  if (!history_.empty()) {
    TENON_TRY(model_, model_in_the_middle(*scene_, start_->options, time_step()));
    connect();
  }
  if (timeline_ != nullptr && run.advanced_to >= 0) {
    const scene::SceneChange change = timeline_->advance(run.advanced_to);
    if (change.structure || (change.bounds && !bounds_.write(*scene_, model_))) {
      return bad_state("its restarts are not those of this scene");
    }
    if (change.gravity) {
      TENON_CHECK(write_gravity());
    }
  }
  advanced_to_ = run.advanced_to;
  return {};
}

// Against the model that its restarts have led to.
Result<void> MujocoSimulation::check_run(const SavedRun& run) const {
  const mjModel& m = *model_.model;
  std::vector<std::size_t> dof_counts;
  for (Index j = 0; j < scene_->joints.size(); ++j) {
    dof_counts.push_back(joint_state(j).position.size());
  }
  TENON_CHECK(check_steering(*scene_, run.steering, dof_counts));
  const auto state_size = static_cast<std::size_t>(mj_stateSize(&m, mjSTATE_INTEGRATION));
  const std::size_t factor_size =
      inputs_.has_acceleration_drives() ? static_cast<std::size_t>(m.nC + m.nv) : 0;
  const bool fits = run.state.size() == state_size && run.factor.size() == factor_size &&
                    run.asleep.size() == static_cast<std::size_t>(m.ntree);
  if (!fits || !all_finite(run.state) || !all_finite(run.factor) || !is_sound_sleep(run.asleep)) {
    return bad_state("it does not fit the model");
  }
  const Work& work = run.work;
  return std::isfinite(work.total()) ? Result<void>() : bad_state("its work is not a number");
}

}  // namespace tenon::engines::mujoco
