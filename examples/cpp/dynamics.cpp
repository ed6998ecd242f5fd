// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// What each joint of an asset has to move and to hold, without an engine: inertia, weight, and how
// fast it moves the last body.
//   dynamics hand.usda thumb=20deg
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "example.h"

#include "tenon/tenon.h"

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: dynamics ASSET [JOINT=VALUE...]\n");
    return 2;
  }
  tenon::Diagnostics diagnostics;
  const tenon::stage::Stage stage =
      or_exit(tenon::open(argv[1], {.physics_variant = "physics"}, diagnostics));
  const tenon::scene::PhysicsScene scene =
      tenon::physics::read_physics(stage, tenon::read_options(), diagnostics);
  tell(diagnostics);
  if (scene.bodies.empty()) {
    std::fprintf(stderr, "%s has no bodies\n", argv[1]);
    return 2;
  }

  const tenon::dynamics::Multibody multibody(scene);
  const std::vector<std::string> pose(argv + 2, argv + argc);
  const tenon::dynamics::Dynamics dynamics(
      multibody, or_exit(tenon::dynamics::posture_from_texts(multibody, pose)));
  std::printf("mass: %.6f kg\n", dynamics.mass());

  const std::vector<double> weight = dynamics.gravity_forces();
  const auto last = static_cast<tenon::scene::Index>(scene.bodies.size() - 1);
  const tenon::Vec3d center =
      tenon::transform_point(dynamics.posture().bodies[last], scene.bodies[last].center_of_mass);
  const tenon::dynamics::DenseMatrix jacobian = dynamics.jacobian(last, center);
  for (std::size_t i = 0; i < multibody.coordinates().size(); ++i) {
    const tenon::dynamics::Coordinate& coordinate = multibody.coordinates()[i];
    if (coordinate.joint) {
      const char* name = scene.joints[*coordinate.joint].path.name().str().c_str();
      const double speed = std::hypot(jacobian.at(0, i), jacobian.at(1, i), jacobian.at(2, i));
      std::printf("inertia of %s: %.9f\n", name, dynamics.effective_inertia(i).held);
      std::printf("weight on %s: %.9f\n", name, weight[i]);
      std::printf("speed by %s: %.9f\n", name, speed);
    }
  }
}
