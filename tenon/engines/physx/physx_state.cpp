// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// PhysX keeps from step to step what nobody can read or write: which points of two shapes touched,
// where friction holds them, in which order pairs were found. So a state is what was set since the
// start, and restoring one makes the run again, on a second simulation that takes the place of this
// one when all went well.
#include <algorithm>
#include <utility>

#include "tenon/base/wire.h"
#include "tenon/engines/physx/physx_simulation.h"
#include "tenon/scene/fields/wire_form.h"

namespace tenon::engines::physx {

namespace {

using scene::Index;

struct SavedRun {
  DriveTerms drives = DriveTerms::Engine;
  Methods methods;
  std::uint64_t steps = 0;
  std::string inputs;  ///< InputLog::bytes
};

constexpr std::uint64_t kMostSteps = 1'000'000'000;

/// Takes numbers from the front of a list; too few make it unsound.
class Numbers {
 public:
  explicit Numbers(const std::vector<double>& numbers) : numbers_(&numbers) {}
  double next() { return at_ < numbers_->size() ? (*numbers_)[at_++] : (is_sound_ = false, 0.0); }
  Vec3d vector() {
    const double x = next();
    const double y = next();
    return {{x, y, next()}};
  }
  Pose pose() {
    Pose pose;
    pose.position = vector();
    pose.orientation.x = next();
    pose.orientation.y = next();
    pose.orientation.z = next();
    pose.orientation.w = next();
    return pose;
  }
  bool is_done() const { return is_sound_ && at_ == numbers_->size(); }

 private:
  const std::vector<double>* numbers_;
  std::size_t at_ = 0;
  bool is_sound_ = true;
};

}  // namespace

StateOwner PhysxSimulation::owner() const {
  return {"physx", physx_version(), scene::scene_hash(*asset_), time_step()};
}

Result<std::string> PhysxSimulation::save_state() const {
  if (!log_.is_whole()) {
    return Error(ErrorCode::Unsupported,
                 "a state on PhysX is what was set since the start, and that is more than " +
                     std::to_string(InputLog::kMostBytes >> 20) + " MiB by now")
        .with_rule("simulation.state")
        .with_fix("save earlier, or set only what changes");
  }
  return seal_state(
      owner(), wire::encoded(SavedRun{options_.drives, options_.methods, steps_, log_.bytes()}));
}

Result<void> PhysxSimulation::restore_state(std::string_view bytes) {
  TENON_TRY(const std::string body, open_state(owner(), bytes));
  const std::optional<SavedRun> run = wire::decoded<SavedRun>(body);
  const auto inputs = run ? read_inputs(run->inputs) : std::nullopt;
  const bool fits =
      inputs && run->steps <= kMostSteps && (inputs->empty() || inputs->back().step <= run->steps);
  if (!fits) {
    return bad_state("its parts do not fit together");
  }
  if (run->drives != options_.drives || run->methods != options_.methods) {
    return Error(ErrorCode::Unsupported, "the saved state is of other SimulationOptions")
        .with_rule("simulation.state");
  }
  Diagnostics silent;
  SimulationOptions options = options_;
  options.time_step = time_step();
  TENON_TRY(std::unique_ptr<PhysxSimulation> fresh, make(*asset_, options, silent));
  for (const Input& input : *inputs) {
    while (fresh->steps_ < input.step) {
      TENON_CHECK(fresh->step());
    }
    TENON_CHECK(fresh->repeat(input));
  }
  while (fresh->steps_ < run->steps) {
    TENON_CHECK(fresh->step());
  }
  take(*fresh);
  return {};
}

Result<void> PhysxSimulation::repeat(const Input& input) {
  Numbers numbers(input.numbers);
  const auto checked = [&](const Result<void>& done) {
    return done && numbers.is_done() ? Result<void>() : bad_state("what was set cannot be");
  };
  const Index object = input.object;
  switch (input.kind) {
    case InputKind::DriveTarget: {
      const double position = numbers.next();
      return checked(set_drive_target(object, input.part, {position, numbers.next()}));
    }
    case InputKind::JointEfforts: {
      const Result<void> done = set_joint_efforts(object, input.numbers);
      return done ? Result<void>() : bad_state("what was set cannot be");
    }
    case InputKind::BodyWrench: {
      const Vec3d force = numbers.vector();
      return checked(set_body_wrench(object, {force, numbers.vector()}));
    }
    case InputKind::KinematicPose:
      return checked(move_kinematic(object, numbers.pose()));
    case InputKind::Gravity:
      return checked(set_gravity(object, numbers.vector()));
    case InputKind::Parameter:
      return checked(set_parameter({input.what, object, input.part}, numbers.next()));
    case InputKind::JointState: {
      const double position = numbers.next();
      return checked(set_joint_state(object, {{position}, {numbers.next()}}));
    }
    case InputKind::BodyState:
      break;
  }
  BodyState state;
  state.pose = numbers.pose();
  state.linear_velocity = numbers.vector();
  state.angular_velocity = numbers.vector();
  return checked(set_body_state(object, state));
}

// The model ends before what it calls.
void PhysxSimulation::take(PhysxSimulation& other) {
  model_ = std::move(other.model_);
  told_ = std::move(other.told_);
  surfaces_ = std::move(other.surfaces_);
  timeline_ = std::move(other.timeline_);
  scene_ = other.scene_;
  inputs_ = std::move(other.inputs_);
  steering_ = std::move(other.steering_);
  events_ = std::move(other.events_);
  contacts_ = std::move(other.contacts_);
  outputs_ = std::move(other.outputs_);
  log_ = std::move(other.log_);
  steps_ = other.steps_;
  stale_ = true;
}

}  // namespace tenon::engines::physx
