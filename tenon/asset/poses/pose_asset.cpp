// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A state of a run is restored by the engine that saved it, in a run of no duration; its bodies say
// where the joints are. Roots stay where the asset has them, since a named pose is of joints.
#include "tenon/asset/poses/pose_asset.h"

#include <algorithm>
#include <utility>

#include "tenon/asset/physics_options.h"
#include "tenon/asset/poses/reach_targets.h"
#include "tenon/asset/poses/start_pose.h"
#include "tenon/asset/simulating/simulate_asset.h"
#include "tenon/base/text/counted.h"
#include "tenon/base/text/name_pattern.h"
#include "tenon/base/text/rounded_text.h"
#include "tenon/physics/read_physics.h"

namespace tenon {
namespace {

/// The joints as the bodies of a saved state have them.
Result<dynamics::Posture> posture_of_state(const std::string& path, const OpenOptions& open,
                                           const physics::Readings& readings,
                                           const PoseRequest& request,
                                           const dynamics::Multibody& multibody,
                                           Diagnostics& diagnostics) {
  SimulateAssetOptions options;
  options.open = open;
  options.readings = readings;
  options.engine = request.engine;
  options.state_in = request.state_in;
  options.duration = 0;
  TENON_TRY(const SimulatedAsset simulated, simulate_asset(path, options, diagnostics));
  const scene::PhysicsScene& scene = multibody.scene();
  const bake::StateRecording& recording = simulated.run.recording;
  if (recording.frame_count() == 0 || recording.body_count != scene.bodies.size()) {
    return Error(ErrorCode::Invalid, "the state has no poses of the bodies")
        .in_file(request.state_in)
        .with_rule("pose.state");
  }
  std::vector<Pose> bodies;
  for (scene::Index i = 0; i < scene.bodies.size(); ++i) {
    bodies.push_back(recording.body(0, i).pose);
  }
  return posture_of_bodies(multibody, bodies);
}

Result<std::vector<bool>> held_joints(const scene::PhysicsScene& scene,
                                      const std::vector<std::string>& texts) {
  std::vector<bool> held(scene.joints.size(), false);
  for (const std::string& text : texts) {
    TENON_TRY(const NamePattern pattern, NamePattern::parse(text));
    bool found = false;
    for (std::size_t j = 0; j < scene.joints.size(); ++j) {
      if (pattern.matches(scene.joints[j].path)) {
        held[j] = true;
        found = true;
      }
    }
    if (!found) {
      return Error(ErrorCode::NotFound, "no joint to hold is called \"" + text + "\"")
          .with_rule("pose.no-joint")
          .with_fix("name a joint as tenon inertia ASSET lists them");
    }
  }
  return held;
}

Result<void> reach_frames(const PoseRequest& request, PoseOfAsset& pose) {
  TENON_TRY(pose.placed, reach_targets(*pose.stage, *pose.scene, request));
  TENON_TRY(pose.options.held, held_joints(*pose.scene, request.hold));
  pose.options.starts = request.starts;
  pose.options.seed = request.seed;
  pose.options.distance = request.tolerance.value_or(pose.options.distance);
  if (pose.placed.empty()) {
    return {};
  }
  std::vector<dynamics::ReachTarget> targets;
  for (const PlacedPrim& placed : pose.placed) {
    targets.push_back(placed.target);
  }
  TENON_TRY(pose.reached, dynamics::reach(*pose.multibody, pose.posture, targets, pose.options));
  pose.posture = pose.reached->posture;
  return {};
}

std::string names_of(const PoseOfAsset& pose, const std::vector<dynamics::AtLimit>& at_limits) {
  std::string names;
  for (const dynamics::AtLimit& one : at_limits) {
    names += (names.empty() ? "" : ", ") + pose.scene->joints[one.joint].path.name().str();
  }
  return names;
}

}  // namespace

Result<PoseOfAsset> pose_of_asset(const std::string& path, const OpenOptions& open,
                                  const physics::Readings& readings, const PoseRequest& request,
                                  Diagnostics& diagnostics) {
  PoseOfAsset pose;
  TENON_TRY(stage::Stage stage, tenon::open(path, with_readings(open, readings), diagnostics));
  pose.stage = std::make_unique<stage::Stage>(std::move(stage));
  pose.scene = std::make_unique<scene::PhysicsScene>(
      physics::read_physics(*pose.stage, read_options(readings), diagnostics));
  pose.multibody = std::make_unique<dynamics::Multibody>(*pose.scene);
  pose.poses = physics::named_poses(*pose.stage);
  if (request.state_in.empty()) {
    TENON_TRY(pose.posture, posture_from_texts(*pose.stage, *pose.multibody, request.pose));
  } else {
    Diagnostics again;  // the asset was read before
    TENON_TRY(pose.posture,
              posture_of_state(path, open, readings, request, *pose.multibody, again));
  }
  TENON_CHECK(reach_frames(request, pose));
  return pose;
}

dynamics::Posture posture_of_bodies(const dynamics::Multibody& multibody,
                                    const std::vector<Pose>& bodies) {
  const dynamics::Posture start = multibody.start();
  const scene::PhysicsScene& scene = multibody.scene();
  std::vector<std::vector<double>> joints = start.joints;
  const auto pose_of = [&](const std::optional<scene::Index>& body) {
    return body ? bodies[*body] : Pose{};
  };
  for (scene::Index j = 0; j < scene.joints.size(); ++j) {
    const scene::Joint& joint = scene.joints[j];
    joints[j] =
        scene::coordinates_at(multibody.dofs()[j], inverse(pose_of(joint.body0) * joint.frame0) *
                                                       (pose_of(joint.body1) * joint.frame1));
  }
  return multibody.moved(start, std::move(joints));
}

std::string reach_obstacle_text(const PoseOfAsset& pose) {
  using dynamics::ReachObstacle;
  if (pose.is_reached()) {
    return {};
  }
  const std::string names = names_of(pose, pose.reached->at_limits);
  switch (pose.reached->obstacle) {
    case ReachObstacle::Limits:
      return "limits of joints are in the way" +
             (names.empty() ? std::string() : "; at a limit: " + names);
    case ReachObstacle::Rotations:
      return "the place is reached, but not with that rotation";
    case ReachObstacle::Together:
      return "each frame is reached alone, but not all of them at once";
    case ReachObstacle::None:
    case ReachObstacle::Distance:
      break;
  }
  return "out of reach: not found without limits either, from " +
         counted(std::min<std::size_t>(pose.reached->starts, 8), "start");
}

}  // namespace tenon
