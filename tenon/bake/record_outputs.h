// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tenon/bake/output_recording.h"
#include "tenon/base/result.h"
#include "tenon/engines/sensors.h"
#include "tenon/engines/simulation.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::bake {

/// "contacts", "efforts", "reactions", "accelerations", "energy", "sensors": what logs can have
/// beside states.
std::vector<std::string> log_output_names();
/// The outputs of these names; others are none. Energy asks for work.
engines::Outputs outputs_named(const std::vector<std::string>& names);
/// The names of outputs that are on.
std::vector<std::string> names_of(const engines::Outputs& outputs);

/// Reads outputs of a simulation, which has them switched on, frame by frame.
class OutputRecorder {
 public:
  /// All that it is made of must outlive it.
  OutputRecorder(const engines::Simulation& simulation, const scene::PhysicsScene& scene,
                 const engines::Outputs& wanted, OutputRecording& recording);

  /// Before the first step, and after each one: sensors measure then.
  Result<void> begin();
  Result<void> after_step();
  /// One frame more. Errors: those of the simulation; Limit "sim.record-too-long".
  Result<void> add_frame();

 private:
  using Numbers = std::vector<double>;
  using Read = std::function<Result<void>(Numbers& values)>;

  void add(OutputSeries series, Read read);
  void add_efforts();
  void add_reactions();
  void add_accelerations();
  void add_energy();
  void add_sensors();
  Result<void> read_contacts();

  const engines::Simulation& simulation_;
  const scene::PhysicsScene& scene_;
  OutputRecording& recording_;
  std::optional<engines::Sensors> sensors_;
  std::vector<Read> reads_;  ///< of each series: appends the numbers of one frame
};

}  // namespace tenon::bake
