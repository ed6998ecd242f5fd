// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The work is done by the Python package (python/tenon_usd/sweep), which checks the values, too:
// here the options are named for help, manual and completions, and handed on as they were given.
// A test holds their names to those of the package.
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "cli/python/python_program.h"
#include "cli/report.h"
#include "cli/verb.h"

namespace tenon::cli {
namespace {

struct SweepRow {
  const char* names;
  const char* value;  ///< the word for it; empty: a flag
  const char* help;
};

constexpr SweepRow kSweepRows[] = {
    {"-o,--output", "FOLDER", "Folder of results, which the same command goes on with; runs"},
    {"-j,--jobs", "COUNT", "Threads, or workers of Ray; 0 is as many as there are processors"},
    {"--vary", "WHAT", "One more row: NAME=LOW..HIGH, NAME=LOW:HIGH:COUNT or NAME=A,B,C"},
    {"--samples", "COUNT", "How many draws of random and sobol"},
    {"--seed", "NUMBER", "What random and sobol draw from"},
    {"--duration", "SECONDS", "Time to simulate"},
    {"--engine", "NAME", "The engine"},
    {"--shard", "I/N", "Only each N-th chunk from the I-th on; I counts from 0"},
    {"--on", "PLACE", "ray: a cluster of this machine; ray=HOST:PORT or ray=auto: one there is"},
    {"--format", "NAME", "parquet, npz or csv; parquet where pyarrow is installed, else csv"},
    {"--merge", "", "Simulate nothing: only put the chunks together"},
    {"--list", "", "Simulate nothing: only print the cases"},
    {"--report", "", "Write FOLDER/report.html, too: a summary with plots"},
};

/// What was given for each row.
struct SweepArguments {
  std::string plan;
  std::deque<std::vector<std::string>> values;
  std::deque<bool> flags;
};

std::vector<std::string> words_of(const SweepArguments& arguments, const Globals& globals) {
  std::vector<std::string> words;
  std::size_t at = 0;
  for (const SweepRow& row : kSweepRows) {
    const std::string names = row.names;
    const std::string name = names.substr(names.rfind(',') + 1);
    for (const std::string& value : arguments.values[at]) {
      words.push_back(name + "=" + value);
    }
    if (arguments.flags[at]) {
      words.push_back(name);
    }
    ++at;
  }
  if (globals.json) {
    words.emplace_back("--json");
  }
  if (globals.quiet) {
    words.emplace_back("--quiet");
  }
  words.emplace_back("--");
  words.push_back(arguments.plan);
  return words;
}

int run_sweep(const Globals& globals, const SweepArguments& arguments) {
  Report report(globals, "sweep", arguments.plan);
  const Result<int> code =
      run_python_program("tenon_usd.sweep.command", words_of(arguments, globals));
  return code ? *code : report.fail(code.error());
}

}  // namespace

void add_sweep(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "sweep", "Simulate with many values, on threads, shards or a cluster (Python package)");
  auto options = std::make_shared<SweepArguments>();
  verb.add_option("plan", options->plan, "A plan (.toml), or an asset that --vary varies")
      .required()
      .file_only();
  for (const SweepRow& row : kSweepRows) {
    std::vector<std::string>& values = options->values.emplace_back();
    bool& flag = options->flags.emplace_back();
    if (*row.value == '\0') {
      verb.add_flag(row.names, flag, row.help);
      continue;
    }
    const Option option = verb.add_option(row.names, values, row.help).value_name(row.value);
    if (std::string(row.names) == "--vary") {
      option.repeatable();
    }
  }
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
