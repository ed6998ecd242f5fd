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

/// Places in kVerbGroups.
enum VerbGroup { kLook, kCheck, kEdit, kSimulate, kShow, kProgram };

struct Verb {
  std::string_view name;
  void (*add)(const Command& parent, const Globals& globals, Chosen& chosen);
  VerbGroup group;
};

constexpr std::array kVerbs{
    Verb{"add", add_add, kEdit},
    Verb{"bake", add_bake, kShow},
    Verb{"bench", add_bench, kSimulate},
    Verb{"benchmark", add_benchmark, kSimulate},
    Verb{"cat", add_cat, kLook},
    Verb{"check", add_check, kCheck},
    Verb{"colliders", add_colliders, kLook},
    Verb{"compare", add_compare, kSimulate},
    Verb{"completion", add_completion, kProgram},
    Verb{"convert", add_convert, kCheck},
    Verb{"diff", add_diff, kLook},
    Verb{"doctor", add_doctor, kProgram},
    Verb{"drives", add_drives, kLook},
    Verb{"dump", add_dump, kLook},
    Verb{"dump-index", add_dump_index, kLook},
    Verb{"excite", add_excite, kSimulate},
    Verb{"explain", add_explain, kLook},
    Verb{"help", add_help, kProgram},
    Verb{"identify", add_identify, kSimulate},
    Verb{"inertia", add_inertia, kLook},
    Verb{"info", add_info, kLook},
    Verb{"manual", add_manual, kProgram},
    Verb{"new", add_new, kEdit},
    Verb{"pairs", add_pairs, kLook},
    Verb{"physics", add_physics, kLook},
    Verb{"pose", add_pose_verb, kEdit},
    Verb{"record", add_record, kShow},
    Verb{"remove", add_remove, kEdit},
    Verb{"rename", add_rename, kEdit},
    Verb{"report", add_report, kShow},
    Verb{"set", add_set, kEdit},
    Verb{"sim", add_sim, kSimulate},
    Verb{"strip", add_strip, kCheck},
    Verb{"structure", add_structure, kCheck},
    Verb{"sweep", add_sweep, kSimulate},
    Verb{"test-runner", add_test_runner, kProgram},
    Verb{"tree", add_tree, kLook},
    Verb{"tune", add_tune, kEdit},
    Verb{"undo", add_undo, kEdit},
    Verb{"variant", add_variant, kCheck},
    Verb{"version", add_version, kProgram},
    Verb{"view", add_view, kShow},
    Verb{"where", add_where, kLook},
    Verb{"zip", add_zip, kCheck},
};

constexpr const char* kAbout = "tenon: convert, check, fix, tune and simulate robot USD";

constexpr const char* kProgramFooter =
    "Examples:\n"
    "  tenon convert hand.urdf hand/           make an asset from a robot description\n"
    "  tenon info hand.usda                    what the asset is, what is missing\n"
    "  tenon tree hand.usda --show physics     its bodies, joints and masses\n"
    "  tenon check hand.usda                   what is wrong with it, and --fix\n"
    "  tenon physics hand.usda --json          what an engine receives, SI and radians\n"
    "  tenon view hand.usda                    look at it and move it, in the browser\n"
    "  tenon sim hand.usda --duration 5        simulate it on MuJoCo\n"
    "  tenon bake hand.usda -o motion.usda     a layer that any USD viewer plays\n"
    "  tenon record hand.usda -o hand.webm     a film of it, or a picture (.png)\n"
    "  tenon report hand.usda -o hand.html     one page with all of it, to look at and to mail\n"
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
  CommandInfo program = make_command_line("", globals, chosen)->describe();
  for (CommandInfo& command : program.commands) {
    for (const Verb& verb : kVerbs) {
      command.group = verb.name == command.name ? kVerbGroups[verb.group] : command.group;
    }
  }
  return program;
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
