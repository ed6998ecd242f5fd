// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Steers a simulation: targets of drives, a torque on a joint, contacts and forces of drives, a
// state that is saved and continued.
//   control_loop grasp.usda
#include <cstdio>
#include <string>

#include "example.h"

#include "tenon/tenon.h"

namespace {

using tenon::engines::World;
using tenon::scene::Index;
using tenon::scene::PhysicsScene;

/// All drives go to a part of the range of their joints.
void close_fingers(World& world, const PhysicsScene& scene, double part) {
  for (Index joint = 0; joint < scene.joints.size(); ++joint) {
    const double upper = scene.joints[joint].upper;
    for (Index drive = 0; drive < scene.joints[joint].drives.size(); ++drive) {
      or_exit(world.set_drive_target(joint, drive, {.position = part * upper}));
    }
  }
}

Index first_driven(const PhysicsScene& scene) {
  Index joint = 0;
  while (scene.joints[joint].drives.empty()) {
    ++joint;
  }
  return joint;
}

Index body_named(const PhysicsScene& scene, const char* name) {
  Index body = 0;
  while (body + 1 < scene.bodies.size() && scene.bodies[body].path.name() != name) {
    ++body;
  }
  return body;
}

/// What contacts exert on a body along the z axis of the world [N].
double force_upwards(const World& world, Index body) {
  double force = 0;
  for (const tenon::engines::Contact& contact : or_exit(world.contacts())) {
    force += contact.body1 == body ? contact.force()[2] : 0;
    force -= contact.body0 == body ? contact.force()[2] : 0;
  }
  return force;
}

double position(const World& world, Index joint) { return world.joint_state(joint).position[0]; }

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: control_loop ASSET\n");
    return 2;
  }
  tenon::Diagnostics diagnostics;
  const auto stage = or_exit(tenon::open(argv[1], {}, diagnostics));
  const PhysicsScene scene =
      tenon::physics::read_physics(stage, tenon::read_options(), diagnostics);
  World world = or_exit(tenon::make_world(
      "mujoco", scene, {.outputs = {.contacts = true, .efforts = true}}, diagnostics));
  const Index joint = first_driven(scene);
  std::printf("joint: %s\n", scene.joints[joint].path.name().str().c_str());

  const double target = 0.2 * scene.joints[joint].upper;
  close_fingers(world, scene, 0.2);
  while (world.time() < 0.5) {
    or_exit(world.step());
  }
  std::printf("target: %.4f rad\n", target);
  std::printf("position: %.4f rad\n", position(world, joint));
  std::printf("effort of the drive: %.5f N m\n", or_exit(world.drive_efforts(joint))[0]);

  const double torque = 0.05;
  or_exit(world.set_joint_efforts(joint, {&torque, 1}));
  const Index can = body_named(scene, "can");
  double sum = 0;
  int steps = 0;
  for (; world.time() < 1; ++steps) {
    or_exit(world.step());
    sum += force_upwards(world, can);
  }
  std::printf("pushed by: %.5f rad\n", position(world, joint) - target);
  std::printf("contacts: %zu\n", world.contact_count());
  std::printf("mean force on the can, upwards: %.4f N\n", sum / steps);

  const std::string state = or_exit(world.save_state());
  or_exit(world.step(100));
  const double first = position(world, joint);
  or_exit(world.restore_state(state));
  or_exit(world.step(100));
  std::printf("continued the same: %s\n", position(world, joint) == first ? "yes" : "no");
}
