// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/output.h"
#include "cli/reading_options.h"
#include "cli/report.h"
#include "cli/text/joints/inertia_text.h"
#include "cli/verb.h"
#include "tenon/answers/inertia_json.h"
#include "tenon/asset/physics_options.h"
#include "tenon/asset/poses/start_pose.h"
#include "tenon/physics/read_physics.h"

namespace tenon::cli {
namespace {

struct InertiaArguments {
  AssetArguments asset;
  std::vector<std::string> assets;
  std::vector<std::string> pose;
  bool matrix = false;
};

int run_inertia(const Globals& globals, const InertiaArguments& options) {
  Report report(globals, "inertia", options.asset.asset);
  const auto stage =
      tenon::open(options.asset.asset, options.asset.open_options(), report.diagnostics);
  if (!stage) {
    return report.fail(stage.error());
  }
  const scene::PhysicsScene scene =
      physics::read_physics(*stage, read_options(), report.diagnostics);
  const dynamics::Multibody multibody(scene);
  auto posture = posture_from_texts(*stage, multibody, options.pose);
  if (!posture) {
    return report.fail(posture.error());
  }
  const dynamics::Dynamics dynamics(multibody, *std::move(posture));
  auto answer = answers::inertia_json(
      multibody, dynamics, options.matrix ? answers::WithMatrix::Yes : answers::WithMatrix::No);
  if (!answer) {
    return report.fail(answer.error());
  }
  if (!globals.json) {
    print_text(inertia_text(*answer));
  }
  return report.finish(kOk, *std::move(answer));
}

constexpr const char* kInertiaFooter =
    "Others held: all other joints stand still, as drives hold them; this is the inertia that "
    "gains "
    "of a drive are made for. Others free: they move as they like. Followers of mimics and the "
    "rest "
    "of a loop move along, floating bodies are free, and armature is in both. Gravity is what "
    "weight "
    "exerts along the joint; a drive that holds it exerts the opposite.\n\n"
    "Examples:\n"
    "  tenon inertia hand.usda\n"
    "  tenon inertia hand.usda --pose 'thumb.*=20deg'\n"
    "  tenon inertia hand.usda --matrix --json";

}  // namespace

void add_inertia(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb =
      parent.add_subcommand("inertia", "The inertia and weight that each joint has to move");
  auto options = std::make_shared<InertiaArguments>();
  options->asset.add_several_to(verb, options->assets);
  add_pose(verb, options->pose);
  verb.add_flag("--matrix", options->matrix, "The mass matrix, too (with --json)")
      .only_with({"--json"});
  verb.footer(kInertiaFooter);
  choose(verb, chosen, [&globals, options] {
    return each_asset(globals, "inertia", options->assets,
                      [&](const Globals& inner, const auto& name) {
                        options->asset.asset = name;
                        return run_inertia(inner, *options);
                      });
  });
}

}  // namespace tenon::cli
