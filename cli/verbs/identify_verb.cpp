// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The work is done by the Python package (python/tenon_usd/identify/identify_command.py), which
// checks the values, too.
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "cli/python/python_verb.h"
#include "cli/verb.h"

namespace tenon::cli {
namespace {

constexpr std::array kIdentifyRows{
    PythonOption{
        "--identify", "FAMILY:REGEX",
        "What to identify of which joints or bodies; =LOW..HIGH behind it for bounds. "
        "Families: friction, damping, stribeck, stribeckSpeed, armature, stiffness, "
        "driveDamping, gains (both), maxForce, delay, mass, offset, effortScale, "
        "contactFriction, mimicRatio, velocityLimit, centerOfMass (along X, Y, Z), inertia "
        "(second moments). Without it what logs usually tell",
        true},
    PythonOption{"--parameters", "FILE", "The same as tables [[parameter]] of a TOML file"},
    PythonOption{"--prior", "FAMILY:REGEX=VALUE,DEVIATION",
                 "A value that is known, and its deviation", true},
    PythonOption{"--hold", "",
                 "What the logs do not tell keeps the asset's number, instead of an error"},
    PythonOption{"--held-out", "LOG", "A log that is not fitted, to prove the result on", true},
    PythonOption{"--training", "PART",
                 "Of each log the part that is fitted, 0.7, where no --held-out is given"},
    PythonOption{"--engine", "NAME", "The engine that simulates"},
    PythonOption{"--physics", "VARIANT", "The variant of \"Physics\""},
    PythonOption{"--dt", "SECONDS", "Time step; without it the asset's"},
    PythonOption{"--window", "SECONDS",
                 "How often the simulation begins at the log's state again: 4, of efforts 0.5"},
    PythonOption{"--solver", "NAME", "gauss-newton, or cma for what is not smooth"},
    PythonOption{"--seed", "NUMBER", "Of cma, --starts and --self-test"},
    PythonOption{"-j,--jobs", "COUNT", "Threads; 0 is as many as there are processors"},
    PythonOption{"--state", "FILE", "Keep the best so far there; the same command goes on from it"},
    PythonOption{"--starts", "COUNT", "Fits from as many starts; the one counts that leaves least"},
    PythonOption{"--on", "PLACE",
                 "The starts on a cluster of Ray: ray of this machine, ray=HOST:PORT or ray=auto"},
    PythonOption{"--check", "", "Fit nothing: only say what the logs tell"},
    PythonOption{"--report", "FILE", "One page with tables and plots (.html)"},
    PythonOption{"--write", "FILE", "A layer over the asset with the numbers (.usda)"},
    PythonOption{"--dry-run", "",
                 "Print the layer that --write would write, with --json as its field layer"},
    PythonOption{"--force", "",
                 "Write also what predicts held-out motion no better, and over a file"},
    PythonOption{"--self-test", "", "Make a log with other numbers and find them: no LOG"},
    PythonOption{"--duration", "SECONDS", "Of the log of --self-test"},
    PythonOption{"--finer", "COUNT", "Steps of the log of --self-test in one time step, 4"},
    PythonOption{"--progress", "",
                 "How far it is as lines of standard error, for programs that show it"},
};

constexpr const char* kIdentifyFooter =
    "Needs the Python package with SciPy (make wheel && pip install dist/tenon_usd-*.whl scipy); "
    "without it the exit code is 4. What the logs cannot tell is refused, with the motion that "
    "would tell it. The asset's files stay as they are: --write makes a layer to open in their "
    "place, where held-out motion is predicted better than before. docs/identify.md walks through "
    "one robot.\n\n"
    "Examples:\n"
    "  tenon identify arm.usda run.csv --report run.html\n"
    "  tenon identify arm.usda run.csv --identify 'friction:.*finger.*' --identify gains --hold\n"
    "  tenon identify arm.usda run.csv --write arm.identified.usda\n"
    "  tenon identify arm.usda run.csv --check\n"
    "  tenon identify arm.usda --self-test";

std::vector<PythonOption> all_rows() {
  std::vector<PythonOption> rows(kIdentifyRows.begin(), kIdentifyRows.end());
  rows.insert(rows.end(), reading_rows().begin(), reading_rows().end());
  return rows;
}

struct IdentifyArguments {
  std::string asset;
  std::vector<std::string> logs;
  PythonArguments options;
};

int run_identify(const Globals& globals, IdentifyArguments& arguments) {
  arguments.options.places = {{arguments.asset}, arguments.logs};
  return run_python_verb(globals, "identify", arguments.asset,
                         "tenon_usd.identify.identify_command", all_rows(), arguments.options);
}

}  // namespace

void add_identify(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "identify", "Find a robot's friction, gains, delays, ... in its logs (Python package)");
  auto options = std::make_shared<IdentifyArguments>();
  verb.add_option("asset", options->asset, "The asset").required().file_only();
  verb.add_option("logs", options->logs, "Logs: .csv, .npz, .parquet, .mcap, folders of bags")
      .file_only();
  add_python_options(verb, all_rows(), options->options);
  verb.footer(kIdentifyFooter);
  choose(verb, chosen, [&globals, options] { return run_identify(globals, *options); });
}

}  // namespace tenon::cli
