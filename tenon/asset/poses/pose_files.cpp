// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The file names joints by their paths, so that its poses are of one robot. Where it has no "_meta"
// it is of an older form, the poses alone, in radians. Degrees are made of radians for joints that
// turn; slides are in units of the stage in both.
#include "tenon/asset/poses/pose_files.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "tenon/answers/json.h"
#include "tenon/base/limits/pose_limits.h"
#include "tenon/base/text/quoted_text.h"
#include "tenon/structure/layout.h"

namespace tenon {
namespace {

using answers::Json;

/// The joints of an asset with one degree of freedom: whether they turn.
std::map<Path, bool> turning_joints(const PoseOfAsset& pose) {
  std::map<Path, bool> joints;
  for (scene::Index j = 0; j < pose.scene->joints.size(); ++j) {
    const scene::JointDofs& dofs = pose.multibody->dofs()[j];
    if (!dofs.ball && dofs.free.size() == 1) {
      joints.emplace(pose.scene->joints[j].path, is_angular(dofs.free[0].dof));
    }
  }
  return joints;
}

Json numbers_json(const std::vector<double>& numbers) { return Json(numbers); }

Json link_json(const Path& path) { return path.empty() ? std::string() : path.str(); }

Error poses_error(const std::string& file, const std::string& why) {
  return Error(ErrorCode::Parse, "no poses can be read from this: " + why)
      .in_file(file)
      .with_rule("pose.file")
      .with_fix(
          "tenon pose ASSET --export FILE.json shows the form: {\"_meta\": {\"units\": "
          "\"radians\"}, \"poses\": {NAME: {\"joints\": {PATH: NUMBER}}}}");
}

class PosesReader {
 public:
  PosesReader(const PoseOfAsset& pose, Path robot, std::string file)
      : joints_(turning_joints(pose)), robot_(robot), file_(std::move(file)) {}

  Result<std::vector<physics::NamedPose>> read(const Json& json) {
    const bool has_frame = json.is_object() && json.contains("_meta") && json.contains("poses");
    const Json& list = has_frame ? json["poses"] : json;
    if (!list.is_object() || list.empty()) {
      return bad("it has no poses by name");
    }
    if (!has_frame && (list.contains("_meta") || list.contains("poses"))) {
      return bad("it has only one of \"_meta\" and \"poses\"");
    }
    if (list.size() > limits::kImportedPoses) {
      return bad("it has more than " + std::to_string(limits::kImportedPoses) + " poses");
    }
    if (has_frame) {
      const Json& meta = json["_meta"];
      const bool says = meta.is_object() && meta.contains("units") && meta["units"].is_string();
      const std::string units = says ? meta["units"].get<std::string>() : "radians";
      if (units != "radians" && units != "degrees") {
        return bad("its unit " + quoted_text(units.substr(0, 40)) +
                   " is neither radians nor degrees");
      }
      degrees_ = units == "degrees";
    }
    std::vector<physics::NamedPose> poses;
    for (const auto& [name, value] : list.items()) {
      TENON_TRY(physics::NamedPose pose, read_pose(name, value));
      poses.push_back(std::move(pose));
    }
    return poses;
  }

 private:
  Result<physics::NamedPose> read_pose(const std::string& name, const Json& json) const {
    if (!is_identifier(name)) {
      return Error(ErrorCode::Invalid, quoted_text(name.substr(0, 100)) + " is not a prim name")
          .in_file(file_)
          .with_rule("edit.bad-name")
          .with_fix("use letters, digits and '_', no digit in front");
    }
    const bool has_joints = json.is_object() && json.contains("joints") &&
                            json["joints"].is_object() && !json["joints"].empty();
    if (!has_joints) {
      return bad("its pose " + quoted_text(name) + " has no joints");
    }
    if (json["joints"].size() > limits::kPoseValues) {
      return bad("its pose " + quoted_text(name) + " has more than " +
                 std::to_string(limits::kPoseValues) + " joints");
    }
    physics::NamedPose pose;
    pose.path = robot_.child(Token(std::string(structure::kNamedPosesScope))).child(Token(name));
    pose.robot = robot_;
    TENON_TRY(pose.start_link, link_of(json, "start_link"));
    TENON_TRY(pose.end_link, link_of(json, "end_link"));
    pose.valid = !json.contains("valid") || json["valid"] == Json(true);
    for (const auto& [joint, value] : json["joints"].items()) {
      TENON_TRY(physics::NamedPoseJoint one, read_joint(name, joint, value));
      const bool says_fixed = json.contains("joint_fixed") && json["joint_fixed"].is_object() &&
                              json["joint_fixed"].contains(joint);
      one.fixed = says_fixed && json["joint_fixed"][joint] == Json(true);
      pose.joints.push_back(one);
    }
    const auto place = numbers_of(json, "target_position", 3);
    const auto turn = numbers_of(json, "target_orientation", 4);
    if (place && turn) {
      pose.target = Pose{{{(*place)[0], (*place)[1], (*place)[2]}},
                         normalized(Quatd{(*turn)[1], (*turn)[2], (*turn)[3], (*turn)[0]})};
    }
    return pose;
  }

  Result<physics::NamedPoseJoint> read_joint(const std::string& pose, const std::string& joint,
                                             const Json& value) const {
    const auto path = Path::parse(joint);
    const auto found = path ? joints_.find(*path) : joints_.end();
    if (found == joints_.end()) {
      return Error(ErrorCode::NotFound, "the pose " + quoted_text(pose) + " names " +
                                            quoted_text(joint.substr(0, 200)) +
                                            ", which is no joint with one degree of freedom here")
          .in_file(file_)
          .with_rule("pose.joint-missing")
          .with_fix("name joints as tenon inertia ASSET lists them, by their paths");
    }
    if (!value.is_number() || !std::isfinite(value.get<double>())) {
      return bad("its pose " + quoted_text(pose) + " has no number for " + joint);
    }
    const double number = value.get<double>();
    return physics::NamedPoseJoint{*path, found->second && !degrees_ ? number * 180 / M_PI : number,
                                   false};
  }

  Result<Path> link_of(const Json& json, const char* key) const {
    if (!json.contains(key) || !json[key].is_string() || json[key].get<std::string>().empty()) {
      return Path();
    }
    const auto path = Path::parse(json[key].get<std::string>());
    if (!path || !path->is_absolute() || !path->is_prim()) {
      return bad(std::string("its ") + key + " is no path of a prim");
    }
    return *path;
  }

  static std::optional<std::vector<double>> numbers_of(const Json& json, const char* key,
                                                       std::size_t count) {
    if (!json.contains(key) || !json[key].is_array() || json[key].size() != count) {
      return std::nullopt;
    }
    std::vector<double> numbers;
    for (const Json& one : json[key]) {
      if (!one.is_number() || !std::isfinite(one.get<double>())) {
        return std::nullopt;
      }
      numbers.push_back(one.get<double>());
    }
    return numbers;
  }

  Error bad(const std::string& why) const { return poses_error(file_, why); }

  std::map<Path, bool> joints_;
  Path robot_;
  std::string file_;
  bool degrees_ = false;
};

}  // namespace

std::string poses_file(const PoseOfAsset& pose) {
  const std::map<Path, bool> turning = turning_joints(pose);
  Json poses = Json::object();
  for (const physics::NamedPose& named : pose.poses) {
    Json joints = Json::object();
    Json fixed = Json::object();
    for (const physics::NamedPoseJoint& one : named.joints) {
      const auto found = turning.find(one.joint);
      if (found != turning.end()) {
        joints[one.joint.str()] = found->second ? one.value * M_PI / 180 : one.value;
        fixed[one.joint.str()] = one.fixed;
      }
    }
    Json row = Json::object();
    row["joints"] = std::move(joints);
    row["joint_fixed"] = std::move(fixed);
    row["start_link"] = link_json(named.start_link);
    row["end_link"] = link_json(named.end_link);
    row["target_position"] = nullptr;
    row["target_orientation"] = nullptr;
    if (named.target) {
      const Vec3d& place = named.target->position;
      const Quatd& turn = named.target->orientation;
      row["target_position"] = numbers_json({place[0], place[1], place[2]});
      row["target_orientation"] = numbers_json({turn.w, turn.x, turn.y, turn.z});
    }
    row["valid"] = named.valid;
    poses[named.path.name().str()] = std::move(row);
  }
  Json json = Json::object();
  json["_meta"] = Json::object();
  json["_meta"]["units"] = "radians";
  json["poses"] = std::move(poses);
  return answers::printed(json);
}

Result<std::vector<physics::NamedPose>> read_poses_file(const PoseOfAsset& pose, const Path& robot,
                                                        const std::string& file,
                                                        const bytes::Files& files) {
  bytes::FileRules rules;
  rules.max_bytes = limits::kPoseFileBytes;
  TENON_TRY(const auto contents, files->open(file, rules));
  TENON_TRY(const Json json, answers::parsed_file(contents->text(), [&](const std::string& why) {
              return poses_error(file, why);
            }));
  return PosesReader(pose, robot, file).read(json);
}

Result<std::vector<physics::NamedPose>> poses_of_text(const PoseOfAsset& pose, const Path& robot,
                                                      std::string_view text) {
  return PosesReader(pose, robot, "").read(answers::parsed(text));
}

}  // namespace tenon
