// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "bench/measure.h"
#include "tenon/engines/simulation.h"

/// What programs share that step an asset through tenon's interface and beside it through plain
/// calls of the engine, chunk by chunk.
namespace tenon::bench {

struct StepOptions {
  std::string file;
  std::size_t chunk = 200;  ///< steps of one lap
  std::size_t chunks = 40;
};

using SimulationPtr = std::unique_ptr<engines::Simulation>;

SimulationPtr make(const std::string& engine, const scene::PhysicsScene& scene);
void step(engines::Simulation& simulation);
void steps(engines::Simulation& simulation, std::size_t count);

/// Largest difference of a place of a body [m].
double difference(const scene::PhysicsScene& scene, const engines::Simulation& one,
                  const engines::Simulation& other);

/// Laps of both sides, `tenon` and `plain`, neither always the first; `begin` before each pair,
/// `end` behind it.
struct Laps {
  std::function<void()> ours;
  std::function<void()> theirs;
  std::function<void()> begin = [] {};
  std::function<void()> end = [] {};
};
void time_in_turns(Report& report, std::size_t chunks, const Laps& laps);

using TimeSteps = void (*)(Report&, const scene::PhysicsScene&, const StepOptions&);

/// The program: NAME FILE [--chunk STEPS] [--chunks N].
int step_beside(const std::string& name, int count, char** values, TimeSteps time_steps);

}  // namespace tenon::bench
