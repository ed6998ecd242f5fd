// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Reads the physics of an asset as every verb of the program does: metres, kilograms, radians.
//   physics hand.usda
#include <cstdio>

#include "example.h"

#include "tenon/tenon.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: physics ASSET\n");
    return 2;
  }
  tenon::Diagnostics diagnostics;
  const tenon::stage::Stage stage =
      or_exit(tenon::open(argv[1], {.physics_variant = "physics"}, diagnostics));
  const tenon::scene::PhysicsScene scene =
      tenon::physics::read_physics(stage, tenon::read_options(), diagnostics);
  tell(diagnostics);

  double mass = 0;
  for (const tenon::scene::Body& body : scene.bodies) {
    mass += body.mass;
  }
  std::printf("bodies: %zu\n", scene.bodies.size());
  std::printf("colliders: %zu\n", scene.colliders.size());
  std::printf("joints: %zu\n", scene.joints.size());
  std::printf("mass: %.6f kg\n", mass);
  for (const tenon::scene::Joint& joint : scene.joints) {
    for (const tenon::scene::Drive& drive : joint.drives) {
      std::printf("%s: %.4f to %.4f rad, drive of %.4f N m/rad\n", joint.path.name().str().c_str(),
                  joint.lower, joint.upper, drive.stiffness);
    }
  }
}
