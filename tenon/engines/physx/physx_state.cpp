// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// PhysX keeps from step to step what nobody can read or write: which points of two shapes touched,
// where friction holds them, in which order pairs were found. So a state is what was set since the
// start, and restoring one makes the run again, on a second simulation that takes the place of this
// one when all went well.
#include <utility>

#include "tenon/engines/physx/physx_simulation.h"
#include "tenon/scene/fields/wire_form.h"

namespace tenon::engines::physx {

StateOwner PhysxSimulation::owner() const {
  return {"physx", physx_version(), scene::scene_hash(*asset_), time_step()};
}

Result<std::string> PhysxSimulation::save_state() const {
  return save_run(owner(), options_, steps_, log_);
}

Result<void> PhysxSimulation::restore_state(std::string_view bytes) {
  TENON_TRY(const RunToRepeat run, open_run(owner(), options_, bytes));
  Diagnostics silent;
  SimulationOptions options = options_;
  options.time_step = time_step();
  TENON_TRY(std::unique_ptr<PhysxSimulation> fresh, make(*asset_, options, silent));
  TENON_CHECK(repeat_run(run, *fresh));
  take(*fresh);
  return {};
}

// The model ends before what it calls.
void PhysxSimulation::take(PhysxSimulation& other) {
  model_ = std::move(other.model_);
  told_ = std::move(other.told_);
  surfaces_ = std::move(other.surfaces_);
  timeline_ = std::move(other.timeline_);
  scene_ = other.scene_;
  inputs_ = std::move(other.inputs_);
  energy_bound_ = std::move(other.energy_bound_);
  passages_ = std::move(other.passages_);
  steering_ = std::move(other.steering_);
  events_ = std::move(other.events_);
  contacts_ = std::move(other.contacts_);
  outputs_ = std::move(other.outputs_);
  log_ = std::move(other.log_);
  steps_ = other.steps_;
  stale_ = true;
}

}  // namespace tenon::engines::physx
