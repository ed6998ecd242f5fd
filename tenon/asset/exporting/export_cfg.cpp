// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/exporting/export_cfg.h"

#include "tenon/asset/exporting/python_cfg.h"
#include "tenon/scene/joint_forest.h"

namespace tenon {
namespace {

constexpr std::size_t kListedLosses = 50;

/// Where the one root that nothing holds stands; the origin where there are others.
Pose free_root(const scene::PhysicsScene& scene) {
  const scene::JointForest forest = scene::joint_forest(scene, scene::FloatingRoots::Directions);
  std::size_t free = 0;
  Pose pose;
  for (const scene::Index root : forest.roots) {
    if (!forest.bodies[root].joint) {
      pose = scene.bodies[root].pose;
      ++free;
    }
  }
  return free == 1 ? pose : Pose{};
}

}  // namespace

ExportedCfg export_cfg(const stage::Stage& stage, const scene::PhysicsScene& scene,
                       DescriptionFormat format, const std::string& file,
                       const std::string& variant, Diagnostics& diagnostics) {
  const bool isaaclab = format == DescriptionFormat::IsaacLab;
  RobotCfg robot;
  const stage::Prim root = stage.default_prim();
  robot.name = root ? root.name().str() : "robot";
  robot.file = file;
  robot.variant = variant;
  robot.root = free_root(scene);
  Diagnostics losses;
  robot.motors =
      joint_motors(stage, scene, isaaclab ? "isaaclab.left-out" : "mjlab.left-out",
                   isaaclab ? "Isaac Lab's configuration" : "mjlab's configuration", losses);
  robot.poses = pose_values(stage, robot.motors, scene.meters_per_unit);
  for (const Diagnostic& loss : losses) {
    if (robot.left_out.size() < kListedLosses) {
      robot.left_out.push_back(python_name(Path::from(loss.prim).name().str()) + ": " +
                               loss.message);
    }
    diagnostics.add(loss);
  }
  return {isaaclab ? isaaclab_cfg(robot) : mjlab_cfg(robot), robot.motors.size()};
}

}  // namespace tenon
