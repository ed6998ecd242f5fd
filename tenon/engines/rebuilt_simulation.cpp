// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A step gives the engine what the asset and the user say about its time (Timeline, Steering), lets
// it advance, looks whether the result can be, and takes what happened.
#include "tenon/engines/rebuilt_simulation.h"

#include <cstdio>
#include <utility>

#include "tenon/scene/fields/wire_form.h"

namespace tenon::engines {

using scene::Index;

RebuiltSimulation::RebuiltSimulation(const scene::PhysicsScene& scene,
                                     const SimulationOptions& options)
    : SteeredSimulation(scene), asset_(&scene), options_(options) {}

Result<void> RebuiltSimulation::begin(double time_step, Diagnostics& diagnostics) {
  time_step_ = time_step;
  timeline_ = timeline_where_needed(*asset_);
  scene_ = timeline_ == nullptr ? asset_ : &timeline_->scene();
  TENON_CHECK(build(Begin::Start, diagnostics));
  start_watches();
  return {};
}

void RebuiltSimulation::start_watches() {
  energy_bound_ = EnergyBound(time_step_);
  passages_ = {};
}

Result<void> RebuiltSimulation::step() {
  if (timeline_ != nullptr) {
    TENON_CHECK(follow_changes());
  }
  begin_outputs();
  energy_bound_.begin(*this, *scene_, steering_);
  passages_.begin(*this, *scene_);
  const double now = time();
  ++steps_;
  TENON_CHECK(advance(now));
  for (Index b = 0; b < scene_->bodies.size(); ++b) {
    if (!is_bounded(b)) {
      return unstable("a body left the finite numbers", scene_->bodies[b].path);
    }
  }
  TENON_CHECK(energy_bound_.end(*this, *scene_, steering_, rule("unstable")));
  for (Event& passage : passages_.end(*this, *scene_)) {
    events_.push_back(std::move(passage));
  }
  end_outputs();
  return note_events();
}

Result<void> RebuiltSimulation::note_events() {
  const NewEvents happened = take_events();
  for (const NewEvents::Passage& passage : happened.passages) {
    const scene::Collider& other = scene_->colliders[passage.other];
    const Path& prim = other.body ? scene_->bodies[*other.body].path : other.path;
    events_.push_back({time(), scene_->colliders[passage.trigger].path,
                       (passage.inside ? "entered by <" : "left by <") + prim.str() + ">"});
  }
  for (const NewEvents::Broken& part : happened.broken) {
    char what[96];
    std::snprintf(what, sizeof what, "broke under %.4g N and %.4g N m", part.force, part.torque);
    events_.push_back({time(), scene_->joints[part.joint].path, what});
    timeline_->break_joint(part.joint);
  }
  return happened.broken.empty() ? Result<void>() : rebuild();
}

Result<void> RebuiltSimulation::follow_changes() {
  scene::SceneChange changed;
  TENON_CHECK(accounted([&]() -> Result<void> {
    changed = timeline_->advance(time());
    return changed.gravity ? write_gravity() : Result<void>();
  }));
  return changed.structure || (changed.bounds && !move_bounds()) ? rebuild() : Result<void>();
}

Result<void> RebuiltSimulation::rebuild() {
  return accounted([&]() -> Result<void> {
    timeline_->restart(states_to_carry());
    Diagnostics silent;  // what there is to say was said at the start
    TENON_CHECK(build(Begin::Middle, silent));
    start_watches();
    return write_steering();
  });
}

std::vector<BodyState> RebuiltSimulation::states_to_carry() const {
  std::vector<BodyState> states;
  for (Index b = 0; b < scene_->bodies.size(); ++b) {
    states.push_back(body_state(b));
  }
  return states;
}

void RebuiltSimulation::note(const Input& input) {
  Input now = input;
  now.step = steps_;
  log_.add(now);
  energy_bound_.note(now);
  passages_.note(now);
}

Error RebuiltSimulation::unstable(const std::string& why, const Path& prim) const {
  char text[64];
  std::snprintf(text, sizeof text, "the simulation became unstable at %.6g s: ", time());
  return Error(ErrorCode::Unstable, text + why)
      .with_rule(rule("unstable"))
      .with_prim(prim.str())
      .with_fix(
          "start within the limits of joints, where one begins outside; else take a smaller "
          "time step or softer drives");
}

Result<void> RebuiltSimulation::reset() {
  steering_ = {};
  events_.clear();
  log_ = {};
  steps_ = 0;
  Diagnostics silent;
  return begin(time_step_, silent);
}

StateOwner RebuiltSimulation::owner() const {
  const EngineObjects engine = engine_objects();
  return {std::string(engine.engine), std::string(engine.version), scene::scene_hash(*asset_),
          time_step_};
}

Result<std::string> RebuiltSimulation::save_state() const {
  return save_run(owner(), options_, steps_, log_);
}

Result<void> RebuiltSimulation::restore_state(std::string_view bytes) {
  TENON_TRY(const RunToRepeat run, open_run(owner(), options_, bytes));
  SimulationOptions options = options_;
  options.time_step = time_step_;
  TENON_TRY(std::unique_ptr<RebuiltSimulation> fresh, another(options));
  TENON_CHECK(repeat_run(run, *fresh));
  take(*fresh);
  return {};
}

void RebuiltSimulation::take(RebuiltSimulation& other) {
  timeline_ = std::move(other.timeline_);
  scene_ = other.scene_;
  steering_ = std::move(other.steering_);
  events_ = std::move(other.events_);
  steps_ = other.steps_;
  energy_bound_ = std::move(other.energy_bound_);
  passages_ = std::move(other.passages_);
  log_ = std::move(other.log_);
}

}  // namespace tenon::engines
