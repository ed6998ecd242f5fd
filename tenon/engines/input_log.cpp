// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A call is a kind, an object and a list of numbers, in the wire form. Making a run again steps a
// simulation from its start and repeats each call before the step it was made before, so what comes
// is the same bits; a call that the simulation then refuses was not made by it: the bytes are
// damaged.
#include "tenon/engines/input_log.h"

#include "tenon/base/limits/run_limits.h"
#include "tenon/base/wire.h"

namespace tenon::engines {
namespace {

using scene::Index;

struct SavedRun {
  DriveTerms drives = DriveTerms::Engine;
  Methods methods;
  std::uint64_t steps = 0;
  std::string inputs;  ///< InputLog::bytes
};

std::vector<double> numbers_of(std::initializer_list<Vec3d> vectors) {
  std::vector<double> numbers;
  for (const Vec3d& vector : vectors) {
    numbers.insert(numbers.end(), vector.v.begin(), vector.v.end());
  }
  return numbers;
}

std::vector<double> numbers_of(const Pose& pose) {
  std::vector<double> numbers = numbers_of({pose.position});
  const Quatd& q = pose.orientation;
  numbers.insert(numbers.end(), {q.x, q.y, q.z, q.w});
  return numbers;
}

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

BodyState body_state_of(Numbers& numbers) {
  BodyState state;
  state.pose = numbers.pose();
  state.linear_velocity = numbers.vector();
  state.angular_velocity = numbers.vector();
  return state;
}

/// Positions, then velocities.
std::optional<JointState> joint_state_of(const std::vector<double>& numbers) {
  if (numbers.size() % 2 != 0) {
    return std::nullopt;
  }
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  return JointState{{numbers.begin(), middle}, {middle, numbers.end()}};
}

Result<void> repeat_input(const Input& input, Simulation& simulation) {
  Numbers numbers(input.numbers);
  const auto damaged = [] { return bad_state("the saved inputs are invalid"); };
  const auto checked = [&](const Result<void>& done) {
    return done && numbers.is_done() ? Result<void>() : damaged();
  };
  const Index object = input.object;
  switch (input.kind) {
    case InputKind::DriveTargets: {
      const double position = numbers.next();
      return checked(simulation.set_drive_target(object, input.part, {position, numbers.next()}));
    }
    case InputKind::JointEfforts:
      return simulation.set_joint_efforts(object, input.numbers) ? Result<void>() : damaged();
    case InputKind::BodyWrenches: {
      const Vec3d force = numbers.vector();
      return checked(simulation.set_body_wrench(object, {force, numbers.vector()}));
    }
    case InputKind::KinematicPoses:
      return checked(simulation.move_kinematic(object, numbers.pose()));
    case InputKind::Gravity:
      return checked(simulation.set_gravity(object, numbers.vector()));
    case InputKind::Parameters:
      return checked(simulation.set_parameter({input.what, object, input.part}, numbers.next()));
    case InputKind::JointStates: {
      const std::optional<JointState> state = joint_state_of(input.numbers);
      return state && simulation.set_joint_state(object, *state) ? Result<void>() : damaged();
    }
    case InputKind::BodyStates:
      break;
  }
  return checked(simulation.set_body_state(object, body_state_of(numbers)));
}

}  // namespace

Input input_of(Index joint, Index drive, const DriveTarget& target) {
  return {.kind = InputKind::DriveTargets,
          .object = joint,
          .part = drive,
          .numbers = {target.position, target.velocity}};
}

Input input_of(Index joint, std::span<const double> efforts) {
  return {.kind = InputKind::JointEfforts,
          .object = joint,
          .numbers = {efforts.begin(), efforts.end()}};
}

Input input_of(Index body, const Wrench& wrench) {
  return {.kind = InputKind::BodyWrenches,
          .object = body,
          .numbers = numbers_of({wrench.force, wrench.torque})};
}

Input input_of(Index body, const Pose& pose) {
  return {.kind = InputKind::KinematicPoses, .object = body, .numbers = numbers_of(pose)};
}

Input input_of(Index scene, const Vec3d& gravity) {
  return {.kind = InputKind::Gravity, .object = scene, .numbers = numbers_of({gravity})};
}

Input input_of(const ParameterKey& key, double value) {
  return {.kind = InputKind::Parameters,
          .what = key.what,
          .object = key.object,
          .part = key.part,
          .numbers = {value}};
}

Input input_of(Index joint, const JointState& state) {
  Input input{.kind = InputKind::JointStates, .object = joint, .numbers = state.position};
  input.numbers.insert(input.numbers.end(), state.velocity.begin(), state.velocity.end());
  return input;
}

Input input_of(Index body, const BodyState& state) {
  Input input{.kind = InputKind::BodyStates, .object = body, .numbers = numbers_of(state.pose)};
  const std::vector<double> speeds = numbers_of({state.linear_velocity, state.angular_velocity});
  input.numbers.insert(input.numbers.end(), speeds.begin(), speeds.end());
  return input;
}

void InputLog::add(const Input& input) {
  if (!whole_) {
    return;
  }
  const std::string encoded = wire::encoded(input);
  if (bytes_.size() + encoded.size() > kMostBytes) {
    whole_ = false;
    bytes_ = {};
    return;
  }
  bytes_ += encoded;
}

std::optional<std::vector<Input>> read_inputs(std::string_view bytes) {
  wire::Decoder decoder(bytes);
  std::vector<Input> inputs;
  while (!decoder.is_done()) {
    Input input;
    decoder.read(input);
    if (!decoder.is_sound() || (!inputs.empty() && input.step < inputs.back().step)) {
      return std::nullopt;
    }
    inputs.push_back(std::move(input));
  }
  return inputs;
}

namespace {

Result<void> check_steps(std::uint64_t steps) {
  if (steps <= limits::kRepeatedSteps) {
    return {};
  }
  return Error(ErrorCode::Limit,
               "a state on this engine is restored by making the run again, and " +
                   std::to_string(steps) + " steps are more than " +
                   std::to_string(limits::kRepeatedSteps) + " (kRepeatedSteps)")
      .with_rule("simulation.state")
      .with_fix("save earlier, or use the engine mujoco, whose states need no steps");
}

}  // namespace

Result<std::string> save_run(const StateOwner& owner, const SimulationOptions& options,
                             std::uint64_t steps, const InputLog& log) {
  if (!log.is_whole()) {
    return Error(
               ErrorCode::Unsupported,
               "a state on this engine is the list of inputs since the start, which is more than " +
                   std::to_string(InputLog::kMostBytes >> 20) + " MiB by now")
        .with_rule("simulation.state")
        .with_fix("save earlier, or set only what changes");
  }
  TENON_CHECK(check_steps(steps));
  return seal_state(owner,
                    wire::encoded(SavedRun{options.drives, options.methods, steps, log.bytes()}));
}

Result<RunToRepeat> open_run(const StateOwner& owner, const SimulationOptions& options,
                             std::string_view bytes) {
  TENON_TRY(const std::string body, open_state(owner, bytes));
  const std::optional<SavedRun> run = wire::decoded<SavedRun>(body);
  auto inputs = run ? read_inputs(run->inputs) : std::nullopt;
  const bool fits = inputs && (inputs->empty() || inputs->back().step <= run->steps);
  if (!fits) {
    return bad_state("its parts do not fit together");
  }
  TENON_CHECK(check_steps(run->steps));
  if (run->drives != options.drives || run->methods != options.methods) {
    return Error(ErrorCode::Unsupported, "the saved state is of other SimulationOptions")
        .with_rule("simulation.state");
  }
  return RunToRepeat{run->steps, *std::move(inputs)};
}

Result<void> repeat_run(const RunToRepeat& run, Simulation& fresh) {
  std::uint64_t steps = 0;
  for (const Input& input : run.inputs) {
    for (; steps < input.step; ++steps) {
      TENON_CHECK(fresh.step());
    }
    TENON_CHECK(repeat_input(input, fresh));
  }
  for (; steps < run.steps; ++steps) {
    TENON_CHECK(fresh.step());
  }
  return {};
}

}  // namespace tenon::engines
