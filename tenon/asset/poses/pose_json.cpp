// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The answer has each joint with what the scene says of it, so that limits and followers are
// seen beside the value; a value whose joint is not there keeps its name alone.
#include "tenon/asset/poses/pose_json.h"

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "tenon/answers/or_null.h"

namespace tenon {
namespace {

using answers::finite_or_null;
using answers::Json;

constexpr double kOutside = 1e-5;  // of a limit, as values are in single precision [rad or m]

Json path_or_none(const Path& path) { return path.empty() ? Json(nullptr) : Json(path.str()); }

/// Its only degree of freedom; none: it has not one.
const scene::FreeDof* only_dof(const dynamics::Multibody& multibody, scene::Index joint) {
  const scene::JointDofs& dofs = multibody.dofs()[joint];
  return !dofs.ball && dofs.free.size() == 1 ? &dofs.free[0] : nullptr;
}

/// A joint of the scene with a value in rad or m.
Json joint_json(const dynamics::Multibody& multibody, scene::Index index, double value) {
  const scene::Joint& joint = multibody.scene().joints[index];
  const scene::FreeDof& dof = *only_dof(multibody, index);
  const scene::Mimic* mimic = dynamics::mimic_of(joint, dof.dof);
  Json row = Json::object();
  row["joint"] = joint.path.str();
  row["dof"] = std::string(scene::dof_name(dof.dof));
  row["value"] = finite_or_null(value);
  row["lower"] = finite_or_null(dof.lower);
  row["upper"] = finite_or_null(dof.upper);
  row["fixed"] = false;
  row["follows"] =
      mimic == nullptr ? Json(nullptr) : Json(multibody.scene().joints[mimic->leader].path.str());
  const bool inside = value >= dof.lower - kOutside && value <= dof.upper + kOutside;
  row["problem"] = inside ? Json(nullptr) : Json("outside");
  return row;
}

/// A value that belongs to no joint with one degree of freedom.
Json lost_json(const physics::NamedPoseJoint& one) {
  Json row = Json::object();
  row["joint"] = one.joint.str();
  row["dof"] = nullptr;
  row["value"] = nullptr;
  row["lower"] = nullptr;
  row["upper"] = nullptr;
  row["fixed"] = one.fixed;
  row["follows"] = nullptr;
  row["problem"] = "missing";
  return row;
}

/// Joints by path.
std::map<Path, scene::Index> joints_of(const PoseOfAsset& pose) {
  std::map<Path, scene::Index> joints;
  for (scene::Index j = 0; j < pose.scene->joints.size(); ++j) {
    joints.emplace(pose.scene->joints[j].path, j);
  }
  return joints;
}

Json pose_json(const PoseOfAsset& pose, const std::map<Path, scene::Index>& joints,
               const physics::NamedPose& named) {
  Json row = Json::object();
  row["name"] = named.path.name().str();
  row["path"] = named.path.str();
  row["robot"] = path_or_none(named.robot);
  row["startLink"] = path_or_none(named.start_link);
  row["endLink"] = path_or_none(named.end_link);
  row["valid"] = named.valid;
  row["joints"] = Json::array();
  for (const physics::NamedPoseJoint& one : named.joints) {
    const auto found = joints.find(one.joint);
    const scene::FreeDof* dof =
        found == joints.end() ? nullptr : only_dof(*pose.multibody, found->second);
    if (dof == nullptr) {
      row["joints"].push_back(lost_json(one));
      continue;
    }
    const double unit = is_angular(dof->dof) ? M_PI / 180 : pose.scene->meters_per_unit;
    Json joint = joint_json(*pose.multibody, found->second, one.value * unit);
    joint["fixed"] = one.fixed;
    row["joints"].push_back(std::move(joint));
  }
  return row;
}

const char* obstacle_name(dynamics::ReachObstacle obstacle) {
  switch (obstacle) {
    case dynamics::ReachObstacle::Limits:
      return "limits";
    case dynamics::ReachObstacle::Rotations:
      return "rotation";
    case dynamics::ReachObstacle::Together:
      return "together";
    case dynamics::ReachObstacle::Distance:
    case dynamics::ReachObstacle::None:
      break;
  }
  return "distance";
}

Json vector_json(const Vec3d& v) { return Json::array({v[0], v[1], v[2]}); }

Json reach_json(const PoseOfAsset& pose) {
  const dynamics::Reached& reached = *pose.reached;
  Json json = Json::object();
  json["reached"] = reached.reached;
  json["obstacle"] = reached.reached ? Json(nullptr) : Json(obstacle_name(reached.obstacle));
  json["starts"] = reached.starts;
  json["seed"] = pose.options.seed;
  json["targets"] = Json::array();
  for (std::size_t i = 0; i < pose.placed.size(); ++i) {
    const PlacedPrim& placed = pose.placed[i];
    const Pose at = pose.posture.bodies[placed.target.body] * placed.target.frame;
    Json row = Json::object();
    row["prim"] = placed.prim.str();
    row["position"] = vector_json(placed.target.position);
    row["at"] = vector_json(at.position);
    row["distance"] = reached.gaps[i].distance;
    row["angle"] = placed.target.orientation ? Json(reached.gaps[i].angle) : Json(nullptr);
    json["targets"].push_back(std::move(row));
  }
  json["atLimits"] = Json::array();
  for (const dynamics::AtLimit& one : reached.at_limits) {
    Json row = Json::object();
    row["joint"] = pose.scene->joints[one.joint].path.str();
    row["dof"] = std::string(scene::dof_name(one.dof));
    row["bound"] = one.bound;
    json["atLimits"].push_back(std::move(row));
  }
  return json;
}

}  // namespace

Json named_poses_json(const PoseOfAsset& pose) {
  const std::map<Path, scene::Index> joints = joints_of(pose);
  Json json = Json::object();
  json["poses"] = Json::array();
  for (const physics::NamedPose& named : pose.poses) {
    json["poses"].push_back(pose_json(pose, joints, named));
  }
  return json;
}

Json named_pose_json(const PoseOfAsset& pose, const physics::NamedPose& named) {
  Json json = Json::object();
  json["pose"] = pose_json(pose, joints_of(pose), named);
  return json;
}

Json posture_json(const PoseOfAsset& pose) {
  Json json = Json::object();
  json["joints"] = Json::array();
  for (scene::Index j = 0; j < pose.scene->joints.size(); ++j) {
    const scene::FreeDof* dof = only_dof(*pose.multibody, j);
    if (dof != nullptr && pose.multibody->coordinate_of(j, dof->dof)) {
      json["joints"].push_back(joint_json(*pose.multibody, j, pose.posture.joints[j][0]));
    }
  }
  if (pose.reached) {
    json["reach"] = reach_json(pose);
  }
  return json;
}

}  // namespace tenon
