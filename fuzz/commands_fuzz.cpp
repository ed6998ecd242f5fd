// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0

// Input: a table of commands for a hinge </A> with one drive and a joint </B> with two. What is
// read is whole and in ascending time, and a run can be given all of it.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "tenon/bake/commands/commands.h"
#include "tenon/bake/test_still_simulation.h"

namespace {

tenon::scene::PhysicsScene driven_scene() {
  using tenon::scene::Dof;
  tenon::scene::PhysicsScene scene;
  scene.meters_per_unit = 1000;
  scene.joints.resize(2);
  scene.joints[0].path = tenon::Path::from("/A");
  scene.joints[0].drives.resize(1);
  scene.joints[1].path = tenon::Path::from("/B");
  scene.joints[1].drives.resize(2);
  scene.joints[1].drives[0].dof = Dof::TransX;
  scene.joints[1].drives[1].dof = Dof::RotX;
  return scene;
}

bool is_sound(const tenon::bake::Commands& commands) {
  bool sound = commands.values.size() == commands.times.size() * commands.columns.size();
  for (std::size_t i = 0; i < commands.times.size(); ++i) {
    sound = sound && std::isfinite(commands.times[i]) &&
            (i == 0 || commands.times[i - 1] < commands.times[i]);
  }
  for (const double value : commands.values) {
    sound = sound && !std::isinf(value);
  }
  return sound;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const tenon::scene::PhysicsScene scene = driven_scene();
  tenon::bake::StillSimulation simulation({1, 2});
  const auto commands = tenon::bake::read_commands(
      tenon::bytes::FileBytes::own({reinterpret_cast<const char*>(data), size}), scene, simulation);
  if (!commands) {
    return 0;
  }
  tenon::bake::CommandPlayer player(*commands, scene, simulation);
  for (int i = 0; i < 10; ++i) {
    if (!player.advance() || !simulation.step()) {
      std::abort();
    }
  }
  return is_sound(*commands) ? 0 : (std::abort(), 1);
}
