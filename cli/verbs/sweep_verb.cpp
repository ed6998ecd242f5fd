// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The work is done by the Python package (python/tenon_usd/sweep), which checks the values, too:
// here the options are named for help, manual and completions, and handed on as they were given.
// A test holds their names to those of the package.
#include <array>
#include <memory>
#include <string>

#include "cli/python/python_verb.h"
#include "cli/verb.h"

namespace tenon::cli {
namespace {

constexpr std::array kSweepRows{
    PythonOption{"-o,--output", "FOLDER",
                 "Folder of results, which the same command goes on with; runs"},
    PythonOption{"-j,--jobs", "COUNT",
                 "Threads, or workers of Ray; 0 is as many as there are processors"},
    PythonOption{"--vary", "WHAT",
                 "One more row: NAME=LOW..HIGH, NAME=LOW:HIGH:COUNT or NAME=A,B,C", true},
    PythonOption{"--samples", "COUNT", "How many draws of random and sobol"},
    PythonOption{"--seed", "NUMBER", "What random and sobol draw from"},
    PythonOption{"--duration", "SECONDS", "Time to simulate"},
    PythonOption{"--engine", "NAME", "The engine"},
    PythonOption{"--shard", "I/N", "Only each N-th chunk from the I-th on; I counts from 0"},
    PythonOption{"--on", "PLACE",
                 "ray: a cluster of this machine; ray=HOST:PORT or ray=auto: one there is"},
    PythonOption{"--format", "NAME",
                 "parquet, npz or csv; parquet where pyarrow is installed, else csv"},
    PythonOption{"--merge", "", "Simulate nothing: only put the chunks together"},
    PythonOption{"--list", "", "Simulate nothing: only print the cases"},
    PythonOption{"--report", "", "Write FOLDER/report.html, too: a summary with plots"},
};

struct SweepArguments {
  std::string plan;
  PythonArguments options;
};

int run_sweep(const Globals& globals, SweepArguments& arguments) {
  arguments.options.places = {{arguments.plan}};
  return run_python_verb(globals, "sweep", arguments.plan, "tenon_usd.sweep.command", kSweepRows,
                         arguments.options);
}

}  // namespace

void add_sweep(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "sweep", "Simulate with many values, on threads, shards or a cluster (Python package)");
  auto options = std::make_shared<SweepArguments>();
  verb.add_option("plan", options->plan, "A plan (.toml), or an asset that --vary varies")
      .required()
      .file_only();
  add_python_options(verb, kSweepRows, options->options);
  verb.footer(
      "Needs the Python package (make wheel && pip install dist/tenon_usd-*.whl); without it the "
      "exit code is 4. The results of a case depend only on the plan and the number of the case: "
      "threads, shards and Ray give the same bytes, and an interrupted run continues where it "
      "stopped. docs/sweep.md has all about plans.\n\n"
      "Examples:\n"
      "  tenon sweep plan.toml -o runs -j 8\n"
      "  tenon sweep hand.usda --vary bodyMass=0.8..1.2 --samples 100 -o runs\n"
      "  tenon sweep plan.toml -o runs --shard 0/4\n"
      "  tenon sweep plan.toml -o runs --on ray");
  choose(verb, chosen, [&globals, options] { return run_sweep(globals, *options); });
}

}  // namespace tenon::cli
