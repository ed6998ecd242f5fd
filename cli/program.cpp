// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The table of verbs, the options that all have, and what is done with a command line: find the
// verb, let it read its options, run it.
#include "cli/program.h"

#include <algorithm>
#include <array>

#include <sys/ioctl.h>
#include <unistd.h>

#include "cli/print.h"
#include "cli/text/help_text.h"

namespace tenon::cli {
namespace {

struct Verb {
  std::string_view name;
  void (*add)(const Command& parent, const Globals& globals, Chosen& chosen);
};

constexpr std::array kVerbs{
    Verb{"add", add_add},
    Verb{"bake", add_bake},
    Verb{"bench", add_bench},
    Verb{"cat", add_cat},
    Verb{"check", add_check},
    Verb{"colliders", add_colliders},
    Verb{"compare", add_compare},
    Verb{"completion", add_completion},
    Verb{"convert", add_convert},
    Verb{"diff", add_diff},
    Verb{"doctor", add_doctor},
    Verb{"drives", add_drives},
    Verb{"dump", add_dump},
    Verb{"dump-index", add_dump_index},
    Verb{"excite", add_excite},
    Verb{"explain", add_explain},
    Verb{"help", add_help},
    Verb{"identify", add_identify},
    Verb{"inertia", add_inertia},
    Verb{"info", add_info},
    Verb{"manual", add_manual},
    Verb{"new", add_new},
    Verb{"pairs", add_pairs},
    Verb{"physics", add_physics},
    Verb{"pose", add_pose_verb},
    Verb{"record", add_record},
    Verb{"remove", add_remove},
    Verb{"rename", add_rename},
    Verb{"report", add_report},
    Verb{"set", add_set},
    Verb{"sim", add_sim},
    Verb{"strip", add_strip},
    Verb{"structure", add_structure},
    Verb{"sweep", add_sweep},
    Verb{"test-runner", add_test_runner},
    Verb{"tree", add_tree},
    Verb{"tune", add_tune},
    Verb{"undo", add_undo},
    Verb{"variant", add_variant},
    Verb{"version", add_version},
    Verb{"view", add_view},
    Verb{"where", add_where},
    Verb{"zip", add_zip},
};

constexpr const char* kAbout = "tenon: open, explain and simulate physics-ready USD assets";

constexpr const char* kProgramFooter =
    "Examples:\n"
    "  tenon info hand.usda                    what the asset is, what is missing\n"
    "  tenon tree hand.usda --show physics     its bodies, joints and masses\n"
    "  tenon check hand.usda                   what is wrong with it, and --fix\n"
    "  tenon physics hand.usda --json          what an engine receives, SI and radians\n"
    "  tenon view hand.usda                    look at it and move it, in the browser\n"
    "  tenon sim hand.usda --duration 5        simulate it on MuJoCo\n"
    "  tenon bake hand.usda -o motion.usda     a layer that any USD viewer plays\n"
    "  tenon record hand.usda -o hand.webm     a film of it, or a picture (.png)\n"
    "  tenon report hand.usda -o hand.html     one page with all of it, to look at and to mail\n"
    "  tenon convert hand.urdf hand.usda       make an asset from a robot description\n"
    "  tenon new scene.usda                    an empty scene, for tenon add to fill\n"
    "  tenon cat model.usdc                    a binary layer as text\n"
    "  tenon help sim                          all about one verb\n"
    "\n"
    "Exit codes: 0 yes or done, 1 the answer is no, 2 wrong usage or unreadable input, 3 the "
    "simulation became unstable, 4 an engine is not installed, 130 interrupted.";

void add_global_options(const Command& root, Globals& globals) {
  root.add_flag("--json", globals.json, "Print exactly one JSON object on standard output");
  root.add_flag("-q,--quiet", globals.quiet, "Only errors on standard error");
  root.add_flag("-v,--verbose", globals.verbose, "Every finding, minor ones and repeated ones too");
  root.add_option("--color", globals.color, "Colours: auto, always or never")
      .one_of({"auto", "always", "never"})
      .value_name("WHEN");
  root.add_flag("--no-settings", globals.no_settings,
                "Do not read tenon.toml (tenon help settings)");
  root.add_flag("-V,--version", globals.version, "Print the version");
}

std::size_t terminal_width() {
  winsize size{};
  const bool known =
      stdout_is_terminal() && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? std::max<std::size_t>(size.ws_col, 40) : kHelpWidth;
}

}  // namespace

std::vector<std::string> verb_names() {
  std::vector<std::string> names;
  for (const Verb& verb : kVerbs) {
    names.emplace_back(verb.name);
  }
  return names;
}

bool is_verb(std::string_view name) {
  return std::any_of(kVerbs.begin(), kVerbs.end(),
                     [&](const Verb& verb) { return verb.name == name; });
}

std::unique_ptr<CommandLine> make_command_line(std::string_view only, Globals& globals,
                                               Chosen& chosen) {
  auto line = std::make_unique<CommandLine>(kAbout, "tenon");
  const Command root = line->root();
  root.footer(kProgramFooter);
  add_global_options(root, globals);
  for (const Verb& verb : kVerbs) {
    if (only.empty() || verb.name == only) {
      verb.add(root, globals, chosen);
    }
  }
  return line;
}

CommandInfo describe_program() {
  Globals globals;
  Chosen chosen;
  return make_command_line("", globals, chosen)->describe();
}

std::string help_of(const CommandInfo& program, const std::vector<std::string>& path) {
  const CommandInfo* command = &program;
  std::string name = program.name;
  for (const std::string& verb : path) {
    command = command->find(verb);
    if (command == nullptr) {
      return {};
    }
    name += " " + verb;
  }
  return help_text(*command, name, path.empty() ? std::vector<OptionInfo>() : program.options,
                   terminal_width());
}

}  // namespace tenon::cli
