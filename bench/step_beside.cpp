// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/step_beside.h"

#include <algorithm>
#include <cstdlib>

#include "tenon/make_simulation.h"
#include "tenon/open_stage.h"
#include "tenon/physics/read_physics.h"

namespace tenon::bench {
namespace {

StepOptions read_options(const std::string& name, int count, char** values) {
  StepOptions options;
  for (int i = 1; i < count; ++i) {
    const std::string word = values[i];
    if ((word == "--chunk" || word == "--chunks") && i + 1 < count) {
      (word == "--chunk" ? options.chunk : options.chunks) = std::strtoul(values[++i], nullptr, 10);
    } else {
      options.file = word;
    }
  }
  if (options.file.empty() || options.chunk == 0 || options.chunks == 0) {
    fail("usage: " + name + " FILE [--chunk STEPS] [--chunks N]");
  }
  return options;
}

}  // namespace

SimulationPtr make(const std::string& engine, const scene::PhysicsScene& scene) {
  Diagnostics diagnostics;
  return value_or_fail(make_simulation(engine, scene, {}, diagnostics));
}

void step(engines::Simulation& simulation) {
  if (auto done = simulation.step(); !done) {
    fail(done.error().to_string());
  }
}

void steps(engines::Simulation& simulation, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    step(simulation);
  }
}

double difference(const scene::PhysicsScene& scene, const engines::Simulation& one,
                  const engines::Simulation& other) {
  double largest = 0;
  for (scene::Index b = 0; b < scene.bodies.size(); ++b) {
    const Vec3d apart = one.body_state(b).pose.position - other.body_state(b).pose.position;
    largest = std::max(largest, length(apart));
  }
  return largest;
}

void time_in_turns(Report& report, std::size_t chunks, const Laps& laps) {
  const auto lap = [&](const char* side, const std::function<void()>& run) {
    report.time(side, [&] {
      run();
      return true;
    });
  };
  for (std::size_t i = 0; i < chunks; ++i) {
    laps.begin();
    if (i % 2 == 0) {
      lap("tenon", laps.ours);
      lap("plain", laps.theirs);
    } else {
      lap("plain", laps.theirs);
      lap("tenon", laps.ours);
    }
    laps.end();
  }
}

int step_beside(const std::string& name, int count, char** values, TimeSteps time_steps) {
  const StepOptions options = read_options(name, count, values);
  Diagnostics diagnostics;
  const stage::Stage stage = value_or_fail(tenon::open(options.file, {}, diagnostics));
  const scene::PhysicsScene scene = physics::read_physics(stage, {}, diagnostics);
  Report report(name);
  time_steps(report, scene, options);
  report.count("steps_per_lap", static_cast<double>(options.chunk));
  report.count("bodies", static_cast<double>(scene.bodies.size()));
  report.print();
  return 0;
}

}  // namespace tenon::bench
