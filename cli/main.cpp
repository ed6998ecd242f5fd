// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <clocale>
#include <cstdio>
#include <optional>
#include <span>
#include <string_view>

#include "cli/command_line.h"
#include "cli/exit_code.h"
#include "cli/verb.h"
#include "tenon/base/heap.h"

namespace {

using tenon::cli::Chosen;
using tenon::cli::Command;
using tenon::cli::CommandLine;
using tenon::cli::Globals;

constexpr const char* kExamples =
    "Examples:\n"
    "  tenon info hand.usda                              what the asset is, what is missing\n"
    "  tenon tree hand.usda --physics physics            its prims, with physics switched on\n"
    "  tenon check hand.usda                             what is wrong with it, and --fix\n"
    "  tenon physics hand.usda --json                    what an engine receives, SI and radians\n"
    "  tenon sim hand.usda --duration 5 -o run.csv       simulate it on MuJoCo\n"
    "  tenon bake hand.usda -o motion.usda               a layer that any USD viewer plays\n"
    "  tenon convert hand.urdf hand.usda                 an asset of a robot's description\n"
    "  tenon cat model.usdc                              a binary layer as text\n"
    "Exit codes: 0 ok, 1 the answer is no, 2 usage, I/O or parse error, 3 unstable simulation,\n"
    "4 engine not installed, 130 interrupted.";

void add_global_options(const Command& root, Globals& globals) {
  root.add_flag("--json", globals.json, "Print exactly one JSON object on standard output");
  root.add_flag("-q,--quiet", globals.quiet, "Only errors on standard error");
  root.add_flag("-v,--verbose", globals.verbose, "Also what is only worth knowing");
  root.add_option("--color", globals.color, "auto, always or never")
      .one_of({"auto", "always", "never"});
  root.add_version_flag("--version", "tenon " TENON_VERSION);
}

struct Verb {
  std::string_view name;
  void (*add)(const Command& parent, const Globals& globals, Chosen& chosen);
};

constexpr Verb kVerbs[] = {
    {"bake", tenon::cli::add_bake},
    {"cat", tenon::cli::add_cat},
    {"check", tenon::cli::add_check},
    {"convert", tenon::cli::add_convert},
    {"diff", tenon::cli::add_diff},
    {"doctor", tenon::cli::add_doctor},
    {"dump", tenon::cli::add_dump},
    {"dump-index", tenon::cli::add_dump_index},
    {"explain", tenon::cli::add_explain},
    {"info", tenon::cli::add_info},
    {"physics", tenon::cli::add_physics},
    {"set", tenon::cli::add_set},
    {"sim", tenon::cli::add_sim},
    {"strip", tenon::cli::add_strip},
    {"structure", tenon::cli::add_structure},
    {"test-runner", tenon::cli::add_test_runner},
    {"tree", tenon::cli::add_tree},
    {"variant", tenon::cli::add_variant},
    {"where", tenon::cli::add_where},
    {"zip", tenon::cli::add_zip},
};

/// The verb that the first argument names, else all: making all of them takes a millisecond.
std::span<const Verb> verbs_for(int argc, char** argv) {
  const std::span<const Verb> all(kVerbs);
  const std::string_view first = argc > 1 ? argv[1] : "";
  const auto named =
      std::find_if(all.begin(), all.end(), [&](const Verb& verb) { return verb.name == first; });
  return named == all.end() ? all : std::span<const Verb>(&*named, 1);
}

int run(int argc, char** argv) {
  const CommandLine line("tenon: open, explain and simulate physics-ready USD assets", "tenon");
  const Command root = line.root();
  Globals globals;
  Chosen chosen;
  root.footer(kExamples);
  root.require_subcommand();
  add_global_options(root, globals);
  for (const Verb& verb : verbs_for(argc, argv)) {
    verb.add(root, globals, chosen);
  }
  if (const std::optional<bool> is_error = line.parse(argc, argv)) {
    return *is_error ? tenon::cli::kFailed : tenon::cli::kOk;
  }
  return chosen.run ? chosen.run() : tenon::cli::kFailed;
}

}  // namespace

int main(int argc, char** argv) {
  tenon::keep_heap_in_huge_pages();
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tenon: error: %s\n", error.what());
    return tenon::cli::kFailed;
  }
}
