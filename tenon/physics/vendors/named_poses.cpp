// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/vendors/named_poses.h"

#include <algorithm>
#include <map>
#include <utility>

#include "tenon/base/limits/pose_limits.h"

namespace tenon::physics {
namespace {

Path first_of(const stage::Prim& prim, const char* name) {
  const std::vector<Path> targets = prim.relationship(Token(name)).targets();
  return targets.empty() ? Path() : targets.front();
}

/// Where the prim's own ops put it; none where it has no such ops.
std::optional<Pose> target_of(const stage::Prim& prim) {
  const auto place = prim.attribute(Token("xformOp:translate")).get_as<Vec3d>();
  const auto turn = prim.attribute(Token("xformOp:orient")).get_as<Quatd>();
  if (!place) {
    return std::nullopt;
  }
  return Pose{*place, turn ? normalized(*turn) : kIdentityRotation};
}

NamedPose read_pose(const stage::Prim& prim) {
  NamedPose pose;
  pose.path = prim.path();
  pose.start_link = first_of(prim, "isaac:robot:pose:startLink");
  pose.end_link = first_of(prim, "isaac:robot:pose:endLink");
  pose.valid = prim.attribute(Token("isaac:robot:pose:valid")).get_as<bool>().value_or(false);
  const std::vector<Path> joints = prim.relationship(Token("isaac:robot:pose:joints")).targets();
  const auto values =
      prim.attribute(Token("isaac:robot:pose:jointValues")).get_as<layer::Array<float>>();
  const auto fixed =
      prim.attribute(Token("isaac:robot:pose:jointFixed")).get_as<layer::Array<bool>>();
  pose.target_count = joints.size();
  pose.value_count = values ? values->size() : 0;
  const std::size_t count = std::min({pose.target_count, pose.value_count, limits::kPoseValues});
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_fixed = fixed && i < fixed->size() && (*fixed)[i];
    pose.joints.push_back({joints[i], static_cast<double>((*values)[i]), is_fixed});
  }
  pose.target = target_of(prim);
  return pose;
}

}  // namespace

std::vector<NamedPose> named_poses(const stage::Stage& stage) {
  const Token type("IsaacNamedPose");
  const Token list(kNamedPosesList);
  std::vector<NamedPose> poses;
  std::map<Path, Path> robots;  // by pose
  std::vector<stage::Prim> waiting{stage.pseudo_root()};
  while (!waiting.empty()) {
    const stage::Prim prim = waiting.back();
    waiting.pop_back();
    if (!prim.is_pseudo_root() && (!prim.is_active() || !prim.is_defined() || prim.is_abstract())) {
      continue;
    }
    if (prim.type_name() == type && poses.size() < limits::kNamedPoses) {
      poses.push_back(read_pose(prim));
    } else if (prim.has_property(list)) {
      for (const Path target : prim.relationship(list).targets()) {
        robots.emplace(target, prim.path());
      }
    }
    const std::vector<stage::Prim> children = prim.children();
    waiting.insert(waiting.end(), children.rbegin(), children.rend());
  }
  for (NamedPose& pose : poses) {
    const auto robot = robots.find(pose.path);
    pose.robot = robot == robots.end() ? Path() : robot->second;
  }
  return poses;
}

}  // namespace tenon::physics
