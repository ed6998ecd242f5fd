// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Words of the command line become options of a run, whose names the parser has checked. An
// interrupt is counted while steps are taken and stops the run, so that its outputs stay whole.
#include "cli/simulate.h"

#include <csignal>

#include "cli/progress.h"
#include "cli/reading_options.h"
#include "cli/settings.h"
#include "tenon/asset/layers/asset_layers.h"
#include "tenon/bake/record_outputs.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/engines/engines.h"

namespace tenon::cli {
namespace {

constexpr auto kOwnIntegrator = engines::Integrator::Default;
constexpr auto kOwnSolver = engines::ConstraintSolver::Default;

volatile std::sig_atomic_t interrupt_count = 0;

extern "C" void count_interrupt(int) { interrupt_count = interrupt_count + 1; }

}  // namespace

/// Counts interrupts, which otherwise end the program, as long as it lives.
class InterruptCounter {
 public:
  InterruptCounter() = default;
  InterruptCounter(const InterruptCounter&) = delete;
  InterruptCounter& operator=(const InterruptCounter&) = delete;
  ~InterruptCounter() { std::signal(SIGINT, previous_); }

 private:
  using Handler = void (*)(int);
  Handler previous_ = std::signal(SIGINT, count_interrupt);
};

Result<SimulateAssetOptions> simulation_options(const SimulateArguments& arguments,
                                                Report& report) {
  SimulateAssetOptions options;
  TENON_TRY(options.engine, engine_for(arguments.engine, arguments.asset.asset, report));
  TENON_TRY(options.readings, chosen_readings(arguments.readings));
  options.pose = arguments.pose;
  options.masks = arguments.masks;
  options.open = arguments.asset.open_options();
  options.duration = arguments.duration;
  options.time_step = arguments.time_step;
  options.frames_per_second = arguments.frames_per_second;
  options.methods = {engines::integrator_named(arguments.integrator).value_or(kOwnIntegrator),
                     engines::solver_named(arguments.solver).value_or(kOwnSolver),
                     static_cast<int>(arguments.iterations)};
  options.outputs = bake::outputs_named(arguments.log);
  options.commands = arguments.commands;
  options.state_in = arguments.state_in;
  if (!arguments.until.empty()) {
    options.until_rest.emplace();
  }
  return options;
}

void SimulateArguments::add_to(const Command& verb) {
  asset.add_with_standard_input_to(verb);
  verb.add_option("--engine", engine,
                  "The engine; without it that of tenon.toml, else that of the selected variant: "
                  "PhysX for physx, else MuJoCo (tenon doctor lists those of this build)")
      .one_of(engines::engine_names())
      .value_name("NAME");
  verb.add_option("--duration", duration, {0, 1e6, false, false, "s"},
                  "Time to simulate; without it the stage's time range, else 5 s")
      .value_name("SECONDS");
  verb.add_option("--dt", time_step, {1e-9, 10, false, false, "s"},
                  "Time step; without it the asset's, else 0.002 s")
      .value_name("SECONDS");
  verb.add_option("--integrator", integrator,
                  "Integration method; without it the asset's, else implicitfast (MuJoCo), euler "
                  "(PhysX and Jolt, which have no other)")
      .one_of(engines::integrator_names())
      .value_name("NAME");
  verb.add_option("--solver", solver,
                  "Solver of contacts and limits; without it the asset's, else newton "
                  "(MuJoCo), pgs (PhysX and Jolt, which have no other)")
      .one_of(engines::solver_names())
      .value_name("NAME");
  verb.add_option(
          "--iterations", iterations, {1, 1e6, false, true, ""},
          "Maximum iterations of the solver; without it the asset's, else 100 (MuJoCo), for "
          "trees of joints and free bodies 32 and 16 (PhysX), 20 and 10 (Jolt)")
      .value_name("COUNT");
  verb.add_option("--fps", frames_per_second, {0, 1e5, true, false, "per second"},
                  "Frames of logs and baked layers");
  add_readings(verb, readings);
  add_pose(verb, pose);
  add_masks(verb, masks);
  verb.add_option("--set", asset.overrides,
                  "PATH.attr=value, or PATH.rel+=PRIM, for this run only; may be repeated")
      .repeatable();
}

void SimulateArguments::add_commands_to(const Command& verb) {
  verb.add_option("--commands", commands,
                  "Drive joints over time by a table, .csv or .npz: time [s], then columns such as "
                  "/hand/joint.target, .velocityTarget (degrees or stage units) and .effort (N, "
                  "N m); each row holds until the next")
      .file_only()
      .value_name("FILE");
}

void SimulateArguments::add_steering_to(const Command& verb) {
  add_commands_to(verb);
  verb.add_option("--state-in", state_in,
                  "Begin from a state that --state-out saved of this asset; --duration counts "
                  "from there")
      .file_only()
      .value_name("FILE");
  verb.add_option("--until", until,
                  "End once every body has been slower than 1 mm/s and 1 degree/s for 0.2 s and "
                  "all commands are given; exit 1 if --duration ends first")
      .one_of({"rest"})
      .value_name("WHEN");
}

int exit_code_of(const SimulatedAsset& simulated) {
  if (simulated.unstable()) {
    return kUnstable;
  }
  if (simulated.run.failure) {
    return exit_code_of(*simulated.run.failure);
  }
  if (simulated.run.interrupted) {
    return kInterrupted;
  }
  return simulated.until_rest && !simulated.run.rest_since ? kNo : kOk;
}

struct RunWatch::Parts {
  Parts(const Globals& globals, const std::string& asset)
      : progress(globals, "reading " + shown_path(asset)) {}
  Progress progress;
  std::optional<InterruptCounter> interrupts;
};

RunWatch::RunWatch(const SimulateArguments& arguments, Report& report)
    : report_(report), parts_(std::make_unique<Parts>(report.globals(), arguments.asset.asset)) {}
RunWatch::~RunWatch() = default;

SimulationListener RunWatch::listener() {
  SimulationListener listener;
  Parts* parts = parts_.get();
  Report& report = report_;
  listener.next_part = [parts](const std::string& what) { parts->progress.next(what); };
  if (!report.json()) {
    listener.announce = [&report](const Diagnostic& finding) {
      if (!report.quiet()) {
        say_aside(diagnostic_line(finding, use_color(report.globals())));
      }
    };
  }
  listener.go_on = [parts](double seconds, double duration) {
    if (!parts->interrupts) {
      parts->interrupts.emplace();  // while steps are taken
    }
    parts->progress.at(seconds, duration, "s");
    return interrupt_count == 0;
  };
  return listener;
}

Result<SimulatedAsset> simulate(const SimulateArguments& arguments, Report& report) {
  TENON_TRY(SimulateAssetOptions options, simulation_options(arguments, report));
  RunWatch watch(arguments, report);
  options.listener = watch.listener();
  return simulate_asset(arguments.asset.asset, options, report.diagnostics);
}

Result<void> put_bake(const SimulatedAsset& simulated, const SimulateArguments& arguments,
                      const std::string& output, Outputs& outputs, Report& report) {
  const layer::Layer layer = motion_layer(simulated, arguments.asset.asset, output,
                                          {.uninstance = arguments.uninstance}, report.diagnostics);
  TENON_TRY(std::string contents, new_contents(layer, output));
  outputs.put(output, std::move(contents));
  return {};
}

}  // namespace tenon::cli
