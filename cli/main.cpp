// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <clocale>
#include <cstdio>

#include <CLI/CLI.hpp>

#include "cli/exit_code.h"
#include "cli/verb.h"

namespace {

using tenon::cli::Chosen;
using tenon::cli::Globals;

constexpr const char* kExamples =
    "Examples:\n"
    "  tenon info hand.usda                              what the asset is, what is missing\n"
    "  tenon tree hand.usda --physics physics            its prims, with physics switched on\n"
    "  tenon check hand.usda                             what is wrong with it, and --fix\n"
    "  tenon physics hand.usda --json                    what an engine receives, SI and radians\n"
    "  tenon sim hand.usda --duration 5 -o run.csv       simulate it on MuJoCo\n"
    "  tenon bake hand.usda -o motion.usda               a layer that any USD viewer plays\n"
    "  tenon cat model.usdc                              a binary layer as text\n"
    "Exit codes: 0 ok, 1 the answer is no, 2 usage, I/O or parse error, 3 unstable simulation,\n"
    "4 engine not installed, 130 interrupted.";

void add_global_options(CLI::App& app, Globals& globals) {
  app.add_flag("--json", globals.json, "Print exactly one JSON object on standard output");
  app.add_flag("-q,--quiet", globals.quiet, "Only errors on standard error");
  app.add_flag("-v,--verbose", globals.verbose, "Also what is only worth knowing");
  app.add_option("--color", globals.color, "auto, always or never")
      ->check(CLI::IsMember({"auto", "always", "never"}));
  app.set_version_flag("--version", "tenon " TENON_VERSION);
}

int run(int argc, char** argv) {
  CLI::App app("tenon: open, explain and simulate physics-ready USD assets", "tenon");
  Globals globals;
  Chosen chosen;
  app.footer(kExamples);
  app.require_subcommand(1);
  app.fallthrough();
  add_global_options(app, globals);
  for (auto* add :
       {tenon::cli::add_bake, tenon::cli::add_cat, tenon::cli::add_check, tenon::cli::add_doctor,
        tenon::cli::add_dump, tenon::cli::add_dump_index, tenon::cli::add_explain,
        tenon::cli::add_info, tenon::cli::add_physics, tenon::cli::add_sim, tenon::cli::add_strip,
        tenon::cli::add_test_runner, tenon::cli::add_tree, tenon::cli::add_variant}) {
    add(app, globals, chosen);
  }
  for (CLI::App* verb : app.get_subcommands({})) {
    verb->fallthrough();
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? tenon::cli::kOk : tenon::cli::kFailed;
  }
  return chosen.run ? chosen.run() : tenon::cli::kFailed;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tenon: error: %s\n", error.what());
    return tenon::cli::kFailed;
  }
}
