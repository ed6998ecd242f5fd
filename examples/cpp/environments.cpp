// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Many simulations of one asset side by side, each with drives of its own stiffness.
//   environments hand.usda
#include <cstdio>
#include <vector>

#include "example.h"

#include "tenon/tenon.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: environments ASSET\n");
    return 2;
  }
  using tenon::scene::Index;
  tenon::Diagnostics diagnostics;
  const auto stage = or_exit(tenon::open(argv[1], {.physics_variant = "physics"}, diagnostics));
  const tenon::scene::PhysicsScene scene =
      tenon::physics::read_physics(stage, tenon::read_options(), diagnostics);
  auto worlds = or_exit(tenon::make_environments("mujoco", scene, {.count = 16}, diagnostics));

  for (std::size_t i = 0; i < worlds.size(); ++i) {
    for (Index joint = 0; joint < scene.joints.size(); ++joint) {
      for (Index drive = 0; drive < scene.joints[joint].drives.size(); ++drive) {
        const double stiffness = scene.joints[joint].drives[drive].stiffness;
        or_exit(worlds[i].set_parameter(
            {tenon::engines::Parameter::DriveStiffness, joint, drive},
            stiffness * static_cast<double>(i + 1) / static_cast<double>(worlds.size())));
      }
    }
  }
  const std::vector<double> targets(worlds.size() * worlds.drive_count(), 0.5);
  or_exit(worlds.set_drive_positions(targets));
  const std::size_t failed = worlds.step(20);

  std::vector<double> positions(worlds.size() * worlds.coordinate_count());
  std::vector<double> velocities(positions.size());
  or_exit(worlds.read_joints(positions, velocities));
  std::printf("environments: %zu, failed: %zu\n", worlds.size(), failed);
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    std::printf("environment %zu: %.6f\n", i, positions[i * worlds.coordinate_count()]);
  }
}
