// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// step_mujoco FILE [--chunk STEPS] [--chunks N]: steps the asset through tenon's interface and a
// copy of the same compiled model through plain calls of mj_step, chunk by chunk, each from the
// same state. Where targets are animated the plain side copies the controls that a run before has
// recorded: what a program that calls MuJoCo itself would do. Count `difference`: largest
// difference of a coordinate at the end of a chunk. Zero: both did the same; it is not where the
// adapter writes what mj_step does not know, such as averaged friction.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <vector>

#include <mujoco/mujoco.h>

#include "bench/step_beside.h"
#include "tenon/engines/mujoco/mujoco_simulation.h"

namespace tenon::bench {
namespace {

const engines::mujoco::MujocoSimulation& adapter(const engines::Simulation& simulation) {
  return static_cast<const engines::mujoco::MujocoSimulation&>(simulation);
}

// What a program sets before each step: controls and poses of kinematic bodies.
class Inputs {
 public:
  explicit Inputs(const mjModel& model)
      : controls_(static_cast<std::size_t>(model.nu)),
        bodies_(static_cast<std::size_t>(model.nmocap)) {}

  void record(const mjData& data) {
    append(data.ctrl, controls_);
    append(data.mocap_pos, 3 * bodies_);
    append(data.mocap_quat, 4 * bodies_);
  }
  bool change() const {
    return !std::equal(values_.begin() + static_cast<std::ptrdiff_t>(row()), values_.end(),
                       values_.begin());
  }
  void apply(std::size_t step, mjData& data) const {
    const double* at = values_.data() + step * row();
    take(data.ctrl, at, controls_);
    take(data.mocap_pos, at + controls_, 3 * bodies_);
    take(data.mocap_quat, at + controls_ + 3 * bodies_, 4 * bodies_);
  }

 private:
  std::size_t row() const { return controls_ + 7 * bodies_; }
  void append(const double* from, std::size_t count) {
    values_.insert(values_.end(), from, from + count);
  }
  static void take(double* to, const double* from, std::size_t count) {
    if (count > 0) {
      std::memcpy(to, from, count * sizeof(double));
    }
  }
  std::size_t controls_;
  std::size_t bodies_;
  std::vector<double> values_;  // (step_count x row)
};

Inputs record_inputs(const scene::PhysicsScene& scene, std::size_t steps) {
  const SimulationPtr simulation = make("mujoco", scene);
  Inputs inputs(adapter(*simulation).engine_model());
  for (std::size_t i = 0; i < steps; ++i) {
    step(*simulation);
    inputs.record(adapter(*simulation).engine_data());
  }
  return inputs;
}

// The copy that is stepped by plain calls.
struct Plain {
  explicit Plain(const engines::Simulation& simulation)
      : model(mj_copyModel(nullptr, &adapter(simulation).engine_model())),
        data(mj_makeData(model)) {
    follow(simulation);
  }
  ~Plain() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }
  Plain(const Plain&) = delete;
  Plain& operator=(const Plain&) = delete;

  void follow(const engines::Simulation& simulation) {
    mj_copyData(data, model, &adapter(simulation).engine_data());
  }

  mjModel* model;
  mjData* data;
};

double difference(const Plain& plain, const engines::Simulation& simulation) {
  const mjData& data = adapter(simulation).engine_data();
  double largest = 0;
  for (int i = 0; i < plain.model->nq; ++i) {
    largest = std::max(largest, std::abs(plain.data->qpos[i] - data.qpos[i]));
  }
  return largest;
}

void time_steps(Report& report, const scene::PhysicsScene& scene, const StepOptions& options) {
  const Inputs inputs = record_inputs(scene, options.chunk * options.chunks);
  const bool animated = inputs.change();
  const SimulationPtr simulation = make("mujoco", scene);
  Plain plain(*simulation);
  double apart = 0;
  std::size_t plain_step = 0;
  Laps laps;
  laps.ours = [&] { steps(*simulation, options.chunk); };
  laps.theirs = [&] {
    for (std::size_t i = 0; i < options.chunk; ++i, ++plain_step) {
      if (animated) {
        inputs.apply(plain_step, *plain.data);
      }
      mj_step(plain.model, plain.data);
    }
  };
  laps.begin = [&] { plain.follow(*simulation); };
  laps.end = [&] { apart = std::max(apart, difference(plain, *simulation)); };
  time_in_turns(report, options.chunks, laps);
  report.count("difference", apart);
  report.count("animated", animated ? 1 : 0);
}

}  // namespace
}  // namespace tenon::bench

int main(int count, char** values) {
  return tenon::bench::step_beside("step_mujoco", count, values, tenon::bench::time_steps);
}
