// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/output.h"
#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/asset/simulating/simulate_asset.h"

/// What `sim` and `bake` share.
namespace tenon::cli {

struct SimulateArguments {
  AssetArguments asset;
  std::vector<std::string> readings;  ///< --reading NAME=VALUE
  std::vector<std::string> pose;      ///< --pose JOINT=VALUE,...
  dynamics::Masks masks;              ///< --deactivate, --bypass, --anchor
  bool uninstance = false;         ///< of bake: instances with bodies inside become ordinary prims
  std::string engine;              ///< empty: what the selected variant names
  std::optional<double> duration;  ///< [s]; not given: what the stage's time range says, else 5
  double time_step = 0;            ///< [s]; 0: the asset's, else the engine's
  double frames_per_second = 60;
  std::string integrator;        ///< --integrator; empty: the asset's, else the engine's
  std::string solver;            ///< --solver
  std::size_t iterations = 0;    ///< --iterations; 0: the asset's, else the engine's
  std::string commands;          ///< of sim: --commands
  std::string state_in;          ///< of sim: --state-in
  std::string until;             ///< of sim: "rest" or empty
  std::vector<std::string> log;  ///< of sim: outputs beside states

  void add_to(const Command& verb);
  /// --commands alone.
  void add_commands_to(const Command& verb);
  /// What only `sim` offers: commands, states, an end at rest.
  void add_steering_to(const Command& verb);
};

/// The options of a run, without a listener; the engine may be that of the settings.
Result<SimulateAssetOptions> simulation_options(const SimulateArguments& arguments, Report& report);

/// Shows progress on a terminal's standard error; an interrupt stops the run. As long as it lives.
class RunWatch {
 public:
  RunWatch(const SimulateArguments& arguments, Report& report);
  ~RunWatch();
  SimulationListener listener();

 private:
  struct Parts;
  Report& report_;
  std::unique_ptr<Parts> parts_;
};

int exit_code_of(const SimulatedAsset& simulated);

/// Runs (tenon/asset/simulating/simulate_asset.h); progress goes to a terminal's standard error,
/// and an interrupt stops the run.
Result<SimulatedAsset> simulate(const SimulateArguments& arguments, Report& report);

/// Puts the overlay layer that plays the run among the outputs.
Result<void> put_bake(const SimulatedAsset& simulated, const SimulateArguments& arguments,
                      const std::string& output, Outputs& outputs, Report& report);

}  // namespace tenon::cli
