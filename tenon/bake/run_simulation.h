// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/bake/commands/commands.h"
#include "tenon/bake/rest.h"
#include "tenon/bake/state_recording.h"
#include "tenon/base/error.h"
#include "tenon/base/function.h"
#include "tenon/engines/simulation.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/watches/run_watches.h"

namespace tenon::bake {

struct RunOptions {
  double duration = 5;            ///< [s] from the time at which the simulation is
  double frames_per_second = 60;  ///< of the recording; 0: record nothing
  /// Recorded beside states, of those that the simulation has; none given: all of these.
  std::optional<engines::Outputs> outputs{};
  /// Called regularly with the simulated time; false stops the run. May be empty.
  Function<bool(double seconds)> go_on;
  const Commands* commands = nullptr;  ///< given as their time comes
  std::optional<RestRule>
      until_rest{};  ///< the run ends where this holds and all commands are given
};

struct Run {
  StateRecording recording;
  std::size_t steps = 0;
  double time = 0;  ///< [s] after the last step that succeeded
  engines::Energy initial_energy;
  engines::Energy final_energy;
  bool interrupted = false;
  std::optional<double> rest_since;      ///< [s]; everything rested from then to the end
  std::vector<engines::Event> events{};  ///< those of the simulation
  watches::RunFaults faults{};           ///< of a run that did not fail
  std::optional<Error> failure;          ///< why the run ended early: unstable, for example
};

/// Steps the simulation for the duration and records frames at the given rate. A frame between two
/// steps is interpolated (linear, slerp); the first and the last are exact states. Frames are at
/// multiples of the frame time, also where the simulation does not begin at 0, so that a run that
/// is continued has the frames of one that never ended. Outputs that are on are recorded too.
Run run_simulation(engines::Simulation& simulation, const scene::PhysicsScene& scene,
                   const RunOptions& options);

}  // namespace tenon::bake
