// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The work is done by the Python package (python/tenon_usd/identify), which checks the values, too.
#include <array>
#include <memory>
#include <string>

#include "cli/python/python_verb.h"
#include "cli/verb.h"

namespace tenon::cli {
namespace {

constexpr std::array kExciteRows{
    PythonOption{"-o,--output", "FILE",
                 "Command table (.csv, .npz) or JointTrajectory of ROS (.yaml)", true},
    PythonOption{"--kind", "NAME", "multisine (as it is without), chirp, steps or ramps"},
    PythonOption{"--joints", "REGEX", "Joints whose path has this in it; else all with a drive"},
    PythonOption{"--duration", "SECONDS", "Time of the motion, without the way there and back; 20"},
    PythonOption{"--step", "SECONDS", "Time between rows; 0.01"},
    PythonOption{"--seed", "NUMBER", "What the motion is drawn from; 0"},
    PythonOption{"--margin", "PART", "Of each range, that is kept to the limits of position; 0.05"},
    PythonOption{"--speed", "PART", "Of the limits of speed, that is used; 0.8"},
    PythonOption{"--effort", "PART", "Of the limits of effort, that is used; 0.8"},
    PythonOption{"--search", "COUNT", "How many multisines are tried; 60"},
    PythonOption{"--no-collisions", "", "Do not look whether bodies touch on the way"},
    PythonOption{"--physics", "NAME", "Variant of the variant sets \"Physics\""},
};

struct ExciteArguments {
  std::string asset;
  PythonArguments options;
};

int run_excite(const Globals& globals, ExciteArguments& arguments) {
  arguments.options.places = {{arguments.asset}};
  return run_python_verb(globals, "excite", arguments.asset, "tenon_usd.identify.excite_command",
                         kExciteRows, arguments.options);
}

}  // namespace

void add_excite(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "excite", "Motions that excite joints, for identification (Python package)");
  auto arguments = std::make_shared<ExciteArguments>();
  verb.add_option("asset", arguments->asset, "A .usd, .usda, .usdc or .usdz file")
      .required()
      .file_only();
  add_python_options(verb, kExciteRows, arguments->options);
  verb.footer(
      "Needs the Python package (make wheel && pip install dist/tenon_usd-*.whl), and MuJoCo to "
      "look for bodies that touch; without them the exit code is 4. The motion keeps the limits of "
      "position, speed and effort, and is made smaller where bodies would touch. "
      "docs/identify-logs.md has all about it.\n\n"
      "Examples:\n"
      "  tenon excite arm.usda -o arm.csv\n"
      "  tenon excite arm.usda --kind ramps --joints 'shoulder|elbow' -o ramps.csv -o ramps.yaml");
  choose(verb, chosen, [&globals, arguments] { return run_excite(globals, *arguments); });
}

}  // namespace tenon::cli
