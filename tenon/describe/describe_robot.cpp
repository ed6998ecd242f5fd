// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/describe/describe_robot.h"

#include <algorithm>
#include <vector>

#include "tenon/describe/body_tree.h"
#include "tenon/describe/colliders.h"
#include "tenon/describe/describe_visuals.h"
#include "tenon/describe/visuals.h"

namespace tenon::describe {
namespace {

robot::RobotModel assembled(RobotTree& tree, Looks looks) {
  robot::RobotModel robot;
  robot.links = std::move(tree.links());
  robot.joints = std::move(tree.joints());
  robot.meshes = std::move(looks.meshes);
  robot.materials = std::move(looks.materials);
  return robot;
}

/// The link that no joint carries.
robot::Index root_of(const robot::RobotModel& robot) {
  std::vector<char> carried(robot.links.size(), 0);
  for (const robot::Joint& joint : robot.joints) {
    carried[joint.child] = 1;
  }
  const auto root = std::find(carried.begin(), carried.end(), 0);
  return static_cast<robot::Index>(root == carried.end() ? 0 : root - carried.begin());
}

/// Bodies beside articulations touch each other.
bool collides_with_itself(const scene::PhysicsScene& scene) {
  return scene.articulations.empty() ||
         std::any_of(scene.articulations.begin(), scene.articulations.end(),
                     [](const scene::Articulation& one) { return one.self_collision; });
}

bool is_of_mujoco(const stage::Prim& prim) { return prim.type_name() == "TenonMujocoSensor"; }

/// What is not simulated, as it reads rays, light or radar, or is of MuJoCo's models alone.
void leave_out_other_sensors(SceneSource& source, const stage::Stage& stage,
                             const scene::PhysicsScene& scene) {
  for (const scene::NotRead& row : scene.not_read) {
    const stage::Prim prim = stage.prim(row.prim);
    const bool is_sensor =
        prim && (prim.is_a("IsaacBaseSensor") || (!source.is_mjcf() && is_of_mujoco(prim)));
    if (is_sensor && prim.type_name().view() == row.property) {
      source.left_out(row.prim, "it is a sensor that is not simulated");
    }
  }
}

}  // namespace

Result<robot::RobotModel> describe_robot(const stage::Stage& stage,
                                         const scene::PhysicsScene& scene, Diagnostics& diagnostics,
                                         Format format) {
  if (scene.bodies.empty()) {
    return Error(ErrorCode::Invalid, "the asset has no rigid bodies, and so no robot")
        .with_rule("urdf.no-robot")
        .with_fix("select a variant with physics");
  }
  SceneSource source(stage, scene, format, diagnostics);
  BodyTree bodies = read_bodies(source);
  Looks looks = add_visuals(source, bodies.tree);
  add_colliders(source, bodies, looks.meshes);
  if (!scene.filter.permanent_sets_off.empty() && !source.is_sdf()) {
    source.left_out({}, "pairs of colliders are kept apart");
  }
  for (const scene::Sensor& sensor : scene.sensors) {
    source.left_out(sensor.path, "it is a sensor");
  }
  leave_out_other_sensors(source, stage, scene);
  robot::RobotModel robot = assembled(bodies.tree, std::move(looks));
  const stage::Prim root = stage.default_prim();
  robot.name = source.name_of(root ? root.path() : Path(), "robot");
  robot.root_pose = bodies.tree.pose(root_of(robot));
  robot.self_collision = collides_with_itself(scene);
  return robot;
}

robot::RobotModel describe_visuals(const stage::Stage& stage, const scene::PhysicsScene& scene,
                                   Diagnostics& diagnostics) {
  SceneSource source(stage, scene, Format::Mjcf, diagnostics);
  RobotTree tree;
  for (const scene::Body& body : scene.bodies) {
    tree.add_link(body.path, source.name_of(body.path, "world"), body.pose, {});
  }
  tree.set_world(tree.add_link({}, "world", {}, {}));
  Looks looks = add_visuals(source, tree);
  leave_out_other_sensors(source, stage, scene);
  return assembled(tree, std::move(looks));
}

}  // namespace tenon::describe
