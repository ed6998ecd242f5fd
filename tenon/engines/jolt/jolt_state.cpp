// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Jolt can write out bodies, contacts and its own constraints, but the laws along coordinates and
// the trees that are held as a whole are ours, and the order in which pairs are found is in
// neither. So a state is what was set since the start, and restoring one makes the run again.
#include <utility>

#include "tenon/engines/jolt/jolt_runtime.h"
#include "tenon/engines/jolt/jolt_simulation.h"
#include "tenon/scene/fields/wire_form.h"

namespace tenon::engines::jolt {

StateOwner JoltSimulation::owner() const {
  return {"jolt", jolt_version(), scene::scene_hash(*asset_), time_step()};
}

Result<std::string> JoltSimulation::save_state() const {
  return save_run(owner(), options_, steps_, log_);
}

Result<void> JoltSimulation::restore_state(std::string_view bytes) {
  TENON_TRY(const RunToRepeat run, open_run(owner(), options_, bytes));
  Diagnostics silent;
  SimulationOptions options = options_;
  options.time_step = time_step();
  TENON_TRY(std::unique_ptr<JoltSimulation> fresh, make(*asset_, options, silent));
  TENON_CHECK(repeat_run(run, *fresh));
  take(*fresh);
  return {};
}

void JoltSimulation::take(JoltSimulation& other) {
  model_ = std::move(other.model_);
  timeline_ = std::move(other.timeline_);
  scene_ = other.scene_;
  inputs_ = std::move(other.inputs_);
  slow_turns_ = std::move(other.slow_turns_);
  energy_bound_ = std::move(other.energy_bound_);
  passages_ = std::move(other.passages_);
  steering_ = std::move(other.steering_);
  events_ = std::move(other.events_);
  contacts_ = std::move(other.contacts_);
  inside_ = std::move(other.inside_);
  breakable_ = std::move(other.breakable_);
  bodies_at_begin_ = std::move(other.bodies_at_begin_);
  joints_at_begin_ = std::move(other.joints_at_begin_);
  log_ = std::move(other.log_);
  steps_ = other.steps_;
}

}  // namespace tenon::engines::jolt
