// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A name is replaced by texts of its joints, in degrees and units of the stage as the asset has
// them, which are then read as all others are. Joints that follow others, close loops or have
// several degrees of freedom are skipped: what they do is decided elsewhere.
#include "tenon/asset/poses/start_pose.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "tenon/base/text/nearest_name.h"
#include "tenon/base/text/quoted_text.h"
#include "tenon/base/text/text_number.h"
#include "tenon/dynamics/posture_text.h"
#include "tenon/scene/joint_dofs.h"

namespace tenon {
namespace {

Error unknown_pose(const std::vector<physics::NamedPose>& poses, const std::string& name) {
  std::vector<std::string> names;
  for (const physics::NamedPose& pose : poses) {
    names.push_back(pose.path.name().str());
  }
  const std::string_view near =
      name.size() < 200 ? nearest_name(name, {names.begin(), names.end()}) : std::string_view();
  const std::string joints = "or give joints, as in thumb=20deg";
  return Error(ErrorCode::NotFound,
               "the asset keeps no pose called " + quoted_text(name.substr(0, 100)))
      .with_rule("pose.unknown")
      .with_fix(!near.empty()   ? "did you mean " + std::string(near) + "?"
                : poses.empty() ? "save one: tenon pose ASSET --save NAME, " + joints
                                : "tenon pose ASSET lists the poses, " + joints);
}

/// A pose that cannot be taken: what is wrong with one of its joints.
Error unusable(const physics::NamedPose& pose, ErrorCode code, const char* rule,
               const std::string& what) {
  const std::string name = pose.path.name().str();
  return Error(code, "the pose " + quoted_text(name) + " " + what)
      .with_prim(pose.path.str())
      .with_rule(rule)
      .with_fix("save it again: tenon pose ASSET --save " + name);
}

/// A coordinate of the joint that leads: joints with one degree of freedom, of trees, that follow
/// no other.
bool leads(const dynamics::Multibody& multibody, scene::Index joint) {
  const scene::JointDofs& dofs = multibody.dofs()[joint];
  return !dofs.ball && dofs.free.size() == 1 &&
         multibody.coordinate_of(joint, dofs.free[0].dof).has_value() &&
         dynamics::mimic_of(multibody.scene().joints[joint], dofs.free[0].dof) == nullptr;
}

Result<void> add_joints(const dynamics::Multibody& multibody, const physics::NamedPose& pose,
                        std::vector<std::string>& texts) {
  std::map<Path, scene::Index> joints;
  for (scene::Index j = 0; j < multibody.scene().joints.size(); ++j) {
    joints.emplace(multibody.scene().joints[j].path, j);
  }
  for (const physics::NamedPoseJoint& one : pose.joints) {
    const auto found = joints.find(one.joint);
    if (found == joints.end()) {
      return unusable(pose, ErrorCode::NotFound, "pose.joint-missing",
                      "names " + one.joint.str() + ", which is no joint here");
    }
    if (!std::isfinite(one.value)) {
      return unusable(pose, ErrorCode::Invalid, "pose.bad-value",
                      "has no finite number for " + one.joint.str());
    }
    if (leads(multibody, found->second)) {
      texts.push_back(one.joint.str() + "=" + shortest(one.value));
    }
  }
  return {};
}

bool is_name(std::string_view text) {
  return !text.empty() && text.find('=') == std::string_view::npos;
}

std::vector<std::string> names_and_joints(const std::vector<std::string>& texts) {
  std::vector<std::string> parts;
  for (const std::string& text : texts) {
    std::size_t begin = 0;
    while (begin <= text.size()) {
      const std::size_t end = std::min(text.find(',', begin), text.size());
      parts.push_back(text.substr(begin, end - begin));
      begin = end + 1;
    }
  }
  return parts;
}

}  // namespace

Result<physics::NamedPose> named_pose(const std::vector<physics::NamedPose>& poses,
                                      const std::string& name) {
  const physics::NamedPose* found = nullptr;
  for (const physics::NamedPose& pose : poses) {
    if (pose.path.str() == name) {
      return pose;
    }
    if (pose.path.name().view() != name) {
      continue;
    }
    if (found != nullptr) {
      return Error(ErrorCode::Invalid, "several poses are called " + quoted_text(name))
          .with_rule("pose.same-name")
          .with_fix("give its path, such as " + found->path.str());
    }
    found = &pose;
  }
  return found == nullptr ? Result<physics::NamedPose>(unknown_pose(poses, name)) : *found;
}

Result<std::vector<std::string>> pose_texts(const stage::Stage& stage,
                                            const dynamics::Multibody& multibody,
                                            const std::vector<std::string>& texts) {
  const std::vector<std::string> parts = names_and_joints(texts);
  if (std::none_of(parts.begin(), parts.end(), is_name)) {
    return texts;
  }
  const std::vector<physics::NamedPose> poses = physics::named_poses(stage);
  std::vector<std::string> joints;
  for (const std::string& part : parts) {
    if (!is_name(part)) {
      joints.push_back(part);
      continue;
    }
    TENON_TRY(const physics::NamedPose pose, named_pose(poses, part));
    TENON_CHECK(add_joints(multibody, pose, joints));
  }
  return joints;
}

Result<dynamics::Posture> posture_from_texts(const stage::Stage& stage,
                                             const dynamics::Multibody& multibody,
                                             const std::vector<std::string>& texts) {
  TENON_TRY(const std::vector<std::string> joints, pose_texts(stage, multibody, texts));
  return dynamics::posture_from_texts(multibody, joints);
}

Result<void> start_at(const stage::Stage& stage, scene::PhysicsScene& scene,
                      const std::vector<std::string>& texts) {
  if (texts.empty()) {
    return {};
  }
  TENON_TRY(const std::vector<std::string> joints,
            pose_texts(stage, dynamics::Multibody(scene), texts));
  return dynamics::start_at(scene, joints);
}

}  // namespace tenon
