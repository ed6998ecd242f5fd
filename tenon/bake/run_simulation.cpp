// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames and steps have rates of their own. States are read only around a step that crosses the
// time of a frame, and a frame between is interpolated from both ends of the step, so a run with
// few frames costs little more than its steps. Frame times are counted, not summed, and do not
// drift; a frame at the end of a step, to 1e-9 of it, has the exact state. The state at the end is
// recorded whether a frame falls there or not, unless the engine failed.
#include "tenon/bake/run_simulation.h"

#include <cmath>

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

class Recorder {
 public:
  Recorder(const Simulation& simulation, const scene::PhysicsScene& scene,
           const RunOptions& options, StateRecording& recording)
      : simulation_(simulation), recording_(recording), rate_(options.frames_per_second) {
    recording_.body_count = scene.bodies.size();
    recording_.joint_count = scene.joints.size();
    for (Frame* frame : {&before_, &now_}) {
      frame->bodies.resize(scene.bodies.size());
      frame->joints.resize(scene.joints.size());
    }
    if (rate_ > 0) {
      read_frame(simulation_, now_);
      store(now_, now_, 1);
    }
  }

  /// Called before a step that may cross a frame's time.
  void before_step(double step) {
    if (rate_ > 0 && next_time() < simulation_.time() + step * (1 + 1e-9)) {
      read_frame(simulation_, before_);
      crossing_ = true;
    }
  }

  void after_step() {
    if (!crossing_) {
      return;
    }
    crossing_ = false;
    read_frame(simulation_, now_);
    const double tolerance = 1e-9 * (now_.time - before_.time);
    while (next_time() <= now_.time + tolerance) {
      store(before_, now_, (next_time() - before_.time) / (now_.time - before_.time));
    }
  }

  /// The final state, unless the last frame was just that.
  void finish() {
    if (rate_ > 0 && !recording_.times.empty() &&
        simulation_.time() - recording_.times.back() > 1e-9 / rate_) {
      read_frame(simulation_, now_);
      const std::size_t frame = stored_;
      store(now_, now_, 1);
      stored_ = frame;
    }
  }

 private:
  double next_time() const { return static_cast<double>(stored_) / rate_; }

  void store(const Frame& a, const Frame& b, double t) {
    const bool exact = t > 1 - 1e-9;
    recording_.times.push_back(&a == &b ? b.time : next_time());
    for (std::size_t i = 0; i < b.bodies.size(); ++i) {
      recording_.bodies.push_back(exact ? b.bodies[i] : mix(a.bodies[i], b.bodies[i], t));
    }
    for (std::size_t i = 0; i < b.joints.size(); ++i) {
      recording_.joints.push_back(exact ? b.joints[i] : mix(a.joints[i], b.joints[i], t));
    }
    ++stored_;
  }

  const Simulation& simulation_;
  StateRecording& recording_;
  double rate_;
  std::size_t stored_ = 0;
  bool crossing_ = false;
  Frame before_;
  Frame now_;
};

constexpr std::size_t kStepsBetweenQuestions = 64;

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
  const double step = simulation.time_step();
  const auto count = static_cast<std::size_t>(std::llround(options.duration / step));
  run.initial_energy = simulation.energy();
  run.time = simulation.time();
  Recorder recorder(simulation, scene, options, run.recording);
  while (run.steps < count) {
    if (run.steps % kStepsBetweenQuestions == 0 && options.go_on &&
        !options.go_on(simulation.time())) {
      run.interrupted = true;
      break;
    }
    recorder.before_step(step);
    if (auto stepped = simulation.step(); !stepped) {
      run.failure = std::move(stepped).error();
      break;
    }
    recorder.after_step();
    ++run.steps;
    run.time = simulation.time();
  }
  if (!run.failure) {
    recorder.finish();
  }
  run.final_energy = simulation.energy();
  return run;
}

}  // namespace tenon::bake
