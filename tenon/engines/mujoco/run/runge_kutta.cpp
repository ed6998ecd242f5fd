// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/run/runge_kutta.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "tenon/engines/mujoco/mujoco_library.h"

namespace tenon::engines::mujoco {
namespace {

constexpr std::array<double, 4> kAhead{0, 0.5, 0.5, 1};  // of the step, where it is evaluated
constexpr std::array<double, 4> kWeight{1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};

/// What positions, velocities and activations change by, per second.
struct Rates {
  std::vector<double> position;  // (dof_count)
  std::vector<double> velocity;  // (dof_count)
  std::vector<double> activation;

  explicit Rates(const mjModel& m)
      : position(static_cast<std::size_t>(m.nv)),
        velocity(position.size()),
        activation(static_cast<std::size_t>(m.na)) {}

  void add(const mjData& d, double weight) {
    for (std::size_t i = 0; i < position.size(); ++i) {
      position[i] += weight * d.qvel[i];
      velocity[i] += weight * d.qacc[i];
    }
    for (std::size_t i = 0; i < activation.size(); ++i) {
      activation[i] += weight * d.act_dot[i];
    }
  }
};

struct Start {
  std::vector<double> qpos, qvel, act;
  double time = 0;

  Start(const mjModel& m, const mjData& d)
      : qpos(d.qpos, d.qpos + m.nq),
        qvel(d.qvel, d.qvel + m.nv),
        act(d.act, d.act + m.na),
        time(d.time) {}

  /// The state after `seconds` at these rates.
  void go(const Rates& rates, double seconds, const mjModel& m, mjData& d) const {
    std::copy(qpos.begin(), qpos.end(), d.qpos);
    mj_integratePos(&m, d.qpos, rates.position.data(), seconds);
    for (std::size_t i = 0; i < qvel.size(); ++i) {
      d.qvel[i] = qvel[i] + seconds * rates.velocity[i];
    }
    for (std::size_t i = 0; i < act.size(); ++i) {
      d.act[i] = act[i] + seconds * rates.activation[i];
    }
    d.time = time + seconds;
  }
};

void clamp_activations(const mjModel& m, mjData& d) {
  for (int i = 0; i < m.nactuator; ++i) {
    const int first = m.actuator_actadr[i];
    if (first < 0 || m.actuator_actlimited[i] == 0) {
      continue;
    }
    const double* range = m.actuator_actrange + std::ptrdiff_t{2} * i;
    for (int k = first; k < first + m.actuator_actnum[i]; ++k) {
      d.act[k] = std::clamp(d.act[k], range[0], range[1]);
    }
  }
}

}  // namespace

void step_runge_kutta(Model& model, const Function<void()>& positions) {
  const mjModel& m = *model.model;
  mjData& d = *model.data;
  const double step = m.opt.timestep;
  const Start start(m, d);
  Rates mean(m);
  for (std::size_t stage = 0; stage < kAhead.size(); ++stage) {
    if (stage > 0) {
      Rates last(m);
      last.add(d, 1);
      start.go(last, kAhead[stage] * step, m, d);
    }
    positions();
    mj_fwdActuation(&m, &d);
    mj_fwdAcceleration(&m, &d);
    mj_fwdConstraint(&m, &d);
    mean.add(d, kWeight[stage]);
  }
  std::copy(d.qacc, d.qacc + m.nv, d.qacc_warmstart);
  start.go(mean, step, m, d);
  clamp_activations(m, d);
}

}  // namespace tenon::engines::mujoco
