// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// step_jolt FILE [--chunk STEPS] [--chunks N]: steps the asset through tenon's interface and a
// second scene of Jolt like it through plain calls of PhysicsSystem::Update, chunk by chunk. For
// assets without joints and without animation: the adapter readies its constraints before each
// step, and the plain side sets nothing. Count `difference`: largest difference of a place at the
// end [m]; the adapter notes contacts that a step begins with, so that it is not zero.
#include "bench/step_beside.h"
#include "tenon/engines/jolt/jolt_headers.h"

namespace tenon::bench {
namespace {

void time_steps(Report& report, const scene::PhysicsScene& scene, const StepOptions& options) {
  const SimulationPtr simulation = make("jolt", scene);
  const SimulationPtr plain = make("jolt", scene);
  auto& system = *const_cast<JPH::PhysicsSystem*>(
      static_cast<const JPH::PhysicsSystem*>(plain->engine_objects().model));
  JPH::TempAllocatorMalloc memory;
  JPH::JobSystemSingleThreaded jobs(2048);
  const auto dt = static_cast<float>(plain->time_step());
  Laps laps;
  laps.ours = [&] { steps(*simulation, options.chunk); };
  laps.theirs = [&] {
    for (std::size_t i = 0; i < options.chunk; ++i) {
      if (system.Update(dt, 1, &memory, &jobs) != JPH::EPhysicsUpdateError::None) {
        fail("Jolt had no room for the contacts");
      }
    }
  };
  time_in_turns(report, options.chunks, laps);
  report.count("difference", difference(scene, *simulation, *plain));
}

}  // namespace
}  // namespace tenon::bench

int main(int count, char** values) {
  return tenon::bench::step_beside("step_jolt", count, values, tenon::bench::time_steps);
}
