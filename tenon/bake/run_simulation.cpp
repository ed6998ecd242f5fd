// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames and steps have rates of their own. States are read only around a step that crosses the
// time of a frame, and a frame between is interpolated from both ends of the step, so a run with
// few frames costs little more than its steps. Frame times are counted, not summed, and do not
// drift; a frame at the end of a step, to 1e-9 of it, has the exact state. The state at the end is
// recorded whether a frame falls there or not, unless the engine failed. Frames are counted from
// time 0 of the simulation, not from where the run begins.
#include "tenon/bake/run_simulation.h"

#include <cmath>
#include <optional>

#include "tenon/bake/record_outputs.h"

namespace tenon::bake {
namespace {

using engines::BodyState;
using engines::JointState;
using engines::Simulation;
using scene::Index;

/// States of everything at one time.
struct Frame {
  double time = 0;
  std::vector<BodyState> bodies;
  std::vector<JointState> joints;
};

void read_frame(const Simulation& simulation, Frame& frame) {
  frame.time = simulation.time();
  for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
    frame.bodies[i] = simulation.body_state(static_cast<Index>(i));
  }
  for (std::size_t i = 0; i < frame.joints.size(); ++i) {
    frame.joints[i] = simulation.joint_state(static_cast<Index>(i));
  }
}

Vec3d mix(const Vec3d& a, const Vec3d& b, double t) { return a * (1 - t) + b * t; }

BodyState mix(const BodyState& a, const BodyState& b, double t) {
  return {{mix(a.pose.position, b.pose.position, t),
           normalized(slerp(a.pose.orientation, b.pose.orientation, t))},
          mix(a.linear_velocity, b.linear_velocity, t),
          mix(a.angular_velocity, b.angular_velocity, t)};
}

JointState mix(const JointState& a, const JointState& b, double t) {
  JointState result = b;
  for (std::size_t i = 0; i < result.position.size() && i < a.position.size(); ++i) {
    result.position[i] = a.position[i] * (1 - t) + b.position[i] * t;
    result.velocity[i] = a.velocity[i] * (1 - t) + b.velocity[i] * t;
  }
  return result;
}

constexpr std::size_t kStepsBetweenQuestions = 64;

engines::Outputs wanted_outputs(const Simulation& simulation, const RunOptions& options) {
  return options.outputs.value_or(simulation.outputs());
}

class Recorder {
 public:
  Recorder(const Simulation& simulation, const scene::PhysicsScene& scene,
           const RunOptions& options, StateRecording& recording)
      : simulation_(simulation),
        recording_(recording),
        rate_(options.frames_per_second),
        outputs_(simulation, scene, wanted_outputs(simulation, options), recording.outputs) {
    recording_.body_count = scene.bodies.size();
    recording_.joint_count = scene.joints.size();
    for (Frame* frame : {&before_, &now_}) {
      frame->bodies.resize(scene.bodies.size());
      frame->joints.resize(scene.joints.size());
    }
  }

  /// The state before the first step.
  Result<void> begin() {
    if (rate_ <= 0) {
      return {};
    }
    TENON_CHECK(outputs_.begin());
    read_frame(simulation_, now_);
    const double frames = now_.time * rate_;
    const bool on_grid =
        std::abs(frames - std::round(frames)) <= 1e-9 * simulation_.time_step() * rate_;
    const double last = on_grid ? std::round(frames) : std::floor(frames);
    next_ = last + 1;
    return store(now_, now_, 1, on_grid ? last / rate_ : now_.time);
  }

  /// Called before a step that may cross a frame's time.
  void before_step(double step) {
    if (rate_ > 0 && next_time() < simulation_.time() + step * (1 + 1e-9)) {
      read_frame(simulation_, before_);
      crossing_ = true;
    }
  }

  Result<void> after_step() {
    if (rate_ > 0) {
      TENON_CHECK(outputs_.after_step());
    }
    if (!crossing_) {
      return {};
    }
    crossing_ = false;
    read_frame(simulation_, now_);
    const double span = now_.time - before_.time;
    for (; next_time() <= now_.time + 1e-9 * span; ++next_) {
      TENON_CHECK(store(before_, now_, (next_time() - before_.time) / span, next_time()));
    }
    return {};
  }

  /// The final state, unless the last frame was just that.
  Result<void> finish() {
    if (rate_ > 0 && !recording_.times.empty() &&
        simulation_.time() - recording_.times.back() > 1e-9 / rate_) {
      read_frame(simulation_, now_);
      return store(now_, now_, 1, now_.time);
    }
    return {};
  }

 private:
  double next_time() const { return next_ / rate_; }

  Result<void> store(const Frame& a, const Frame& b, double t, double time) {
    TENON_CHECK(outputs_.add_frame());
    const bool exact = t > 1 - 1e-9;
    recording_.times.push_back(time);
    for (std::size_t i = 0; i < b.bodies.size(); ++i) {
      recording_.bodies.push_back(exact ? b.bodies[i] : mix(a.bodies[i], b.bodies[i], t));
    }
    for (std::size_t i = 0; i < b.joints.size(); ++i) {
      recording_.joints.push_back(exact ? b.joints[i] : mix(a.joints[i], b.joints[i], t));
    }
    return {};
  }

  const Simulation& simulation_;
  StateRecording& recording_;
  double rate_;
  OutputRecorder outputs_;
  double next_ = 0;  ///< number of the next frame, counted from time 0
  bool crossing_ = false;
  Frame before_;
  Frame now_;
};

/// One run from its first question to its last step.
class Runner {
 public:
  Runner(Simulation& simulation, const scene::PhysicsScene& scene, const RunOptions& options,
         Run& run)
      : simulation_(simulation),
        options_(options),
        run_(run),
        recorder_(simulation, scene, options, run.recording),
        watches_(
            simulation, scene,
            options.commands == nullptr ? watches::Steering::None : watches::Steering::Commands) {
    if (options.commands != nullptr) {
      commands_.emplace(*options.commands, scene, simulation);
    }
    if (options.until_rest) {
      rest_.emplace(simulation, scene, *options.until_rest);
    }
  }

  Result<void> all_steps() {
    TENON_CHECK(recorder_.begin());
    const double step = simulation_.time_step();
    const auto count = static_cast<std::size_t>(std::llround(options_.duration / step));
    while (run_.steps < count && !run_.rest_since) {
      if (is_stopped()) {
        run_.interrupted = true;
        break;
      }
      TENON_CHECK(one_step(step));
    }
    run_.faults = watches_.faults();
    return recorder_.finish();
  }

 private:
  bool is_stopped() const {
    return run_.steps % kStepsBetweenQuestions == 0 && options_.go_on &&
           !options_.go_on(simulation_.time());
  }

  Result<void> one_step(double step) {
    if (commands_) {
      TENON_CHECK(commands_->advance());
    }
    recorder_.before_step(step);
    TENON_CHECK(simulation_.step());
    watches_.after_step();
    TENON_CHECK(recorder_.after_step());
    ++run_.steps;
    run_.time = simulation_.time();
    if (rest_ && (!commands_ || commands_->is_done())) {
      run_.rest_since = rest_->look();
    }
    return {};
  }

  Simulation& simulation_;
  const RunOptions& options_;
  Run& run_;
  Recorder recorder_;
  watches::RunWatches watches_;
  std::optional<CommandPlayer> commands_;
  std::optional<RestWatch> rest_;
};

}  // namespace

PoseRecording StateRecording::poses() const {
  PoseRecording result;
  result.times = times;
  result.body_count = body_count;
  result.poses.reserve(bodies.size());
  for (const BodyState& state : bodies) {
    result.poses.push_back(state.pose);
  }
  return result;
}

Run run_simulation(Simulation& simulation, const scene::PhysicsScene& scene,
                   const RunOptions& options) {
  Run run;
  run.initial_energy = simulation.energy();
  run.time = simulation.time();
  Runner runner(simulation, scene, options, run);
  if (auto done = runner.all_steps(); !done) {
    run.failure = std::move(done).error();
  }
  run.final_energy = simulation.energy();
  run.events = simulation.events();
  return run;
}

}  // namespace tenon::bake
