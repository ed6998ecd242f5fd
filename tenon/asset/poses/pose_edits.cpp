// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The form is that of Isaac Sim's robot poser: below the robot a scope Named_Poses, in it a prim of
// type IsaacNamedPose for each pose, and the robot's list isaac:robot:namedPoses names all of them.
// Values are degrees and units of the stage in single precision. What a property says already is
// not written again, so that a pose that is saved twice gives the same bytes.
#include "tenon/asset/poses/pose_edits.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "tenon/asset/edit_value.h"
#include "tenon/asset/poses/start_pose.h"
#include "tenon/base/text/quoted_text.h"
#include "tenon/base/text/rounded_text.h"
#include "tenon/base/text/text_number.h"
#include "tenon/stage/transform_at.h"
#include "tenon/structure/layout.h"

namespace tenon {
namespace {

constexpr const char* kStartLink = "isaac:robot:pose:startLink";
constexpr const char* kEndLink = "isaac:robot:pose:endLink";
constexpr const char* kJoints = "isaac:robot:pose:joints";
constexpr const char* kValues = "isaac:robot:pose:jointValues";
constexpr const char* kFixed = "isaac:robot:pose:jointFixed";
constexpr const char* kValid = "isaac:robot:pose:valid";

Result<void> check_name(const std::string& name) {
  if (!is_identifier(name)) {
    return Error(ErrorCode::Invalid, quoted_text(name.substr(0, 100)) + " is not a prim name")
        .with_rule("edit.bad-name")
        .with_fix("use letters, digits and '_', no digit in front");
  }
  return {};
}

std::vector<Path> robots_of(const stage::Stage& stage) {
  std::vector<Path> robots;
  std::vector<stage::Prim> waiting{stage.pseudo_root()};
  while (!waiting.empty()) {
    const stage::Prim prim = waiting.back();
    waiting.pop_back();
    if (!prim.is_pseudo_root() && prim.is_active() && prim.has_api(Token("IsaacRobotAPI"))) {
      robots.push_back(prim.path());
    }
    const std::vector<stage::Prim> children = prim.children();
    waiting.insert(waiting.end(), children.rbegin(), children.rend());
  }
  return robots;
}

Error no_robot(ErrorCode code, const std::string& message, const std::string& fix) {
  return Error(code, message).with_rule("pose.no-robot").with_fix(fix);
}

/// The joint has one degree of freedom, and a coordinate of a tree.
bool has_value(const dynamics::Multibody& multibody, scene::Index joint) {
  const scene::JointDofs& dofs = multibody.dofs()[joint];
  return !dofs.ball && dofs.free.size() == 1 &&
         multibody.coordinate_of(joint, dofs.free[0].dof).has_value();
}

/// Tells what is beyond limits, to the single precision of values; true where nothing is.
bool keeps_limits(const PoseOfAsset& pose, scene::Index joint, Diagnostics& diagnostics) {
  constexpr double kSingle = 1e-5;  // [rad or m]
  const scene::FreeDof& dof = pose.multibody->dofs()[joint].free[0];
  const double at = pose.posture.joints[joint][0];
  if (at >= dof.lower - kSingle && at <= dof.upper + kSingle) {
    return true;
  }
  const double unit = is_angular(dof.dof) ? M_PI / 180 : pose.scene->meters_per_unit;
  diagnostics.add({Severity::Warning, "pose.outside-limits",
                   "the pose puts the joint to " + rounded_text(at / unit) +
                       ", beyond its limits of " + rounded_text(dof.lower / unit) + " and " +
                       rounded_text(dof.upper / unit) + ": it is marked as not valid",
                   pose.scene->joints[joint].path.str(), "", ""});
  return false;
}

/// Where the frame that was placed first is, in the robot's frame and in units of the stage.
Pose end_in_robot(const PoseOfAsset& pose, const Path& robot) {
  const dynamics::ReachTarget& target = pose.placed.front().target;
  const Pose world = pose.posture.bodies[target.body] * target.frame;
  const Mat4d from =
      stage::local_to_world(pose.stage->prim(robot), stage::Time(pose.scene->start_time_code));
  const Vec3d place =
      transform_point(world.position * (1 / pose.scene->meters_per_unit), inverse(from));
  const Vec3d scale = row_scale(from);
  Mat3d rotation;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      rotation[i][j] = from[i][j] / scale[i];
    }
  }
  return {place, normalized(conjugate(normalized(rotation_of(rotation))) * world.orientation)};
}

/// The root of the tree that the joints of a robot belong to.
Path start_link_of(const PoseOfAsset& pose, scene::Index joint) {
  const scene::Joint& j = pose.scene->joints[joint];
  const scene::Index body = j.body1 ? *j.body1 : *j.body0;
  return pose.scene->bodies[pose.multibody->forest().bodies[body].root].path;
}

/// Edits of one prim, without those that change nothing.
class PoseWriter {
 public:
  PoseWriter(const stage::Stage& stage, std::vector<AssetEdit>& edits)
      : stage_(stage), edits_(edits) {}

  void define(const Path& prim, const char* type) {
    if (!stage_.prim(prim)) {
      AssetEdit edit = edit_of(AssetEdit::Kind::DefinePrim, prim);
      edit.type_name = Token(type);
      edits_.push_back(std::move(edit));
    }
  }
  /// An attribute; `type` is of one that no schema declares.
  void set(const Path& prim, const char* name, const std::string& value, const char* type = "") {
    const stage::Prim there = stage_.prim(prim);
    if (there && composed_text(there, Token(name)) == value) {
      return;
    }
    AssetEdit edit = edit_of(AssetEdit::Kind::SetProperty, prim.property(Token(name)));
    edit.value = value;
    edit.type_name = Token(type);
    edits_.push_back(std::move(edit));
  }
  void target(const Path& prim, const char* name, const std::vector<Path>& targets) {
    const stage::Prim there = stage_.prim(prim);
    if (there && there.relationship(Token(name)).targets() == targets) {
      return;
    }
    if (targets.empty()) {
      clear(prim, name);
      return;
    }
    AssetEdit edit = edit_of(AssetEdit::Kind::SetProperty, prim.property(Token(name)));
    edit.value = joined_paths(targets);
    edits_.push_back(std::move(edit));
  }
  void add_target(const Path& prim, const char* name, const std::vector<Path>& targets) {
    const std::vector<Path> has = stage_.prim(prim).relationship(Token(name)).targets();
    std::vector<Path> more;
    for (const Path& path : targets) {
      if (std::find(has.begin(), has.end(), path) == has.end()) {
        more.push_back(path);
      }
    }
    if (!more.empty()) {
      AssetEdit edit = edit_of(AssetEdit::Kind::AddTargets, prim.property(Token(name)));
      edit.value = joined_paths(more);
      edits_.push_back(std::move(edit));
    }
  }
  void clear(const Path& prim, const char* name) {
    const stage::Prim there = stage_.prim(prim);
    if (there && (there.attribute(Token(name)).is_authored() ||
                  there.relationship(Token(name)).is_authored())) {
      edits_.push_back(edit_of(AssetEdit::Kind::ClearProperty, prim.property(Token(name))));
    }
  }
  void apply(const Path& prim, const char* api) {
    AssetEdit edit = edit_of(AssetEdit::Kind::ApplyApi, prim);
    edit.api = Token(api);
    edits_.push_back(std::move(edit));
  }

  static AssetEdit edit_of(AssetEdit::Kind kind, const Path& object) {
    AssetEdit edit;
    edit.kind = kind;
    edit.object = object;
    edit.may_rest = true;  // engines receive no poses
    return edit;
  }

 private:
  static std::string joined_paths(const std::vector<Path>& paths) {
    std::string text;
    for (const Path& path : paths) {
      text += (text.empty() ? "" : ",") + path.str();
    }
    return text;
  }

  const stage::Stage& stage_;
  std::vector<AssetEdit>& edits_;
};

template <class Text>
std::string array_text(const physics::NamedPose& pose, const Text& text) {
  std::string list;
  for (const physics::NamedPoseJoint& joint : pose.joints) {
    list += (list.empty() ? "" : ", ") + text(joint);
  }
  return "[" + list + "]";
}

std::string numbers_text(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) {
    text += (text.empty() ? "" : ", ") + layer_text(number);
  }
  return "(" + text + ")";
}

void write_pose(const physics::NamedPose& pose, PoseWriter& writer) {
  const Path& at = pose.path;
  const auto one = [](const Path& path) {
    return path.empty() ? std::vector<Path>() : std::vector<Path>{path};
  };
  writer.define(at, "IsaacNamedPose");
  writer.target(at, kStartLink, one(pose.start_link));
  writer.target(at, kEndLink, one(pose.end_link));
  std::vector<Path> joints;
  for (const physics::NamedPoseJoint& joint : pose.joints) {
    joints.push_back(joint.joint);
  }
  writer.target(at, kJoints, joints);
  writer.set(at, kValues, array_text(pose, [](const physics::NamedPoseJoint& joint) {
               return layer_text(static_cast<float>(joint.value));
             }));
  writer.set(at, kFixed, array_text(pose, [](const physics::NamedPoseJoint& joint) {
               return std::string(joint.fixed ? "1" : "0");
             }));
  writer.set(at, kValid, pose.valid ? "1" : "0");
  if (!pose.target) {
    writer.clear(at, "xformOpOrder");
    writer.clear(at, "xformOp:translate");
    writer.clear(at, "xformOp:orient");
    return;
  }
  const Vec3d& place = pose.target->position;
  const Quatd& turn = pose.target->orientation;
  writer.set(at, "xformOp:translate", numbers_text({place[0], place[1], place[2]}), "double3");
  writer.set(at, "xformOp:orient", numbers_text({turn.w, turn.x, turn.y, turn.z}), "quatd");
  writer.set(at, "xformOpOrder", "[\"xformOp:translate\", \"xformOp:orient\"]");
}

/// The schema with what robot tools look for first: links and joints in kinematic order.
void make_robot(const PoseOfAsset& pose, const Path& robot, PoseWriter& writer) {
  if (pose.stage->prim(robot).has_api(Token("IsaacRobotAPI"))) {
    return;
  }
  writer.apply(robot, "IsaacRobotAPI");
  std::vector<Path> links;
  std::vector<Path> joints;
  const dynamics::Multibody& multibody = *pose.multibody;
  for (const scene::Index body : multibody.forest().order) {
    const std::optional<scene::Index> joint = multibody.forest().bodies[body].joint;
    if (pose.scene->bodies[body].path.has_prefix(robot)) {
      links.push_back(pose.scene->bodies[body].path);
    }
    if (joint && pose.scene->joints[*joint].path.has_prefix(robot)) {
      joints.push_back(pose.scene->joints[*joint].path);
    }
  }
  writer.add_target(robot, "isaac:physics:robotLinks", links);
  writer.add_target(robot, "isaac:physics:robotJoints", joints);
}

Path scope_of(const Path& robot) {
  return robot.child(Token(std::string(structure::kNamedPosesScope)));
}

}  // namespace

Result<Path> robot_of_poses(const PoseOfAsset& pose, const std::string& robot) {
  if (!robot.empty()) {
    const auto path = Path::parse(robot);
    if (!path || !path->is_absolute() || !path->is_prim() || !pose.stage->prim(*path)) {
      return no_robot(ErrorCode::NotFound, "there is no prim " + quoted_text(robot),
                      "tenon tree ASSET lists the prims");
    }
    return *path;
  }
  const std::vector<Path> robots = robots_of(*pose.stage);
  if (robots.size() > 1) {
    return no_robot(ErrorCode::Invalid, "the asset has several robots",
                    "say which one keeps the pose: --robot " + robots.front().str());
  }
  if (robots.size() == 1) {
    return robots.front();
  }
  const stage::Prim root = pose.stage->default_prim();
  if (!root) {
    return no_robot(ErrorCode::NotFound, "the asset has no robot and no default prim",
                    "say which prim keeps the pose: --robot PRIM");
  }
  return root.path();
}

Result<physics::NamedPose> pose_to_save(const PoseOfAsset& pose, const Path& robot,
                                        const std::string& name, Diagnostics& diagnostics) {
  TENON_CHECK(check_name(name));
  const dynamics::Multibody& multibody = *pose.multibody;
  const dynamics::Posture start = multibody.start();
  physics::NamedPose saved;
  saved.path = scope_of(robot).child(Token(name));
  saved.robot = robot;
  saved.valid = pose.is_reached();
  for (scene::Index j = 0; j < pose.scene->joints.size(); ++j) {
    const scene::Joint& joint = pose.scene->joints[j];
    if (!joint.path.has_prefix(robot)) {
      continue;
    }
    if (has_value(multibody, j)) {
      const bool turns = is_angular(multibody.dofs()[j].free[0].dof);
      const double unit = turns ? M_PI / 180 : pose.scene->meters_per_unit;
      const bool held = j < pose.options.held.size() && pose.options.held[j];
      saved.valid = keeps_limits(pose, j, diagnostics) && saved.valid;
      saved.start_link = saved.joints.empty() ? start_link_of(pose, j) : saved.start_link;
      saved.joints.push_back({joint.path, pose.posture.joints[j][0] / unit, held});
    } else if (multibody.dofs()[j].count() > 1 && pose.posture.joints[j] != start.joints[j]) {
      diagnostics.add({Severity::Warning, "pose.skipped-joint",
                       "a named pose has one value for a joint, and this one has several degrees "
                       "of freedom: it is skipped",
                       joint.path.str(), "", ""});
    }
  }
  if (saved.joints.empty()) {
    return Error(ErrorCode::Invalid, "no joint below " + robot.str() + " has a value to keep")
        .with_rule("pose.no-joints")
        .with_fix("choose a variant with physics (--physics), or another robot (--robot)");
  }
  if (!pose.placed.empty()) {
    saved.end_link = pose.placed.front().prim;
    saved.target = end_in_robot(pose, robot);
  }
  return saved;
}

Result<std::vector<AssetEdit>> save_edits(const PoseOfAsset& pose, const Path& robot,
                                          const std::vector<physics::NamedPose>& saved) {
  std::vector<AssetEdit> edits;
  PoseWriter writer(*pose.stage, edits);
  make_robot(pose, robot, writer);
  writer.define(scope_of(robot), "Scope");
  std::vector<Path> paths;
  for (const physics::NamedPose& one : saved) {
    const stage::Prim there = pose.stage->prim(one.path);
    if (there && there.type_name() != structure::kNamedPoseType) {
      return Error(ErrorCode::Invalid, "the prim of that name is no pose")
          .with_prim(one.path.str())
          .with_rule("pose.no-pose")
          .with_fix("give the pose another name");
    }
    write_pose(one, writer);
    paths.push_back(one.path);
  }
  writer.add_target(robot, physics::kNamedPosesList, paths);
  return edits;
}

Result<std::vector<AssetEdit>> rename_edits(const PoseOfAsset& pose, const std::string& request) {
  const std::size_t equals = request.rfind('=');
  if (equals == std::string::npos) {
    return Error(ErrorCode::Invalid, quoted_text(request.substr(0, 100)) + " says no new name")
        .with_rule("edit.bad-argument")
        .with_fix("write OLD=NEW, as in grasp=power_grasp");
  }
  const std::string name = request.substr(equals + 1);
  TENON_TRY(const physics::NamedPose named, named_pose(pose.poses, request.substr(0, equals)));
  TENON_CHECK(check_name(name));
  if (pose.stage->prim(named.path.parent().child(Token(name)))) {
    return Error(ErrorCode::Invalid, "there is a pose " + quoted_text(name) + " already")
        .with_rule("pose.has-it-already")
        .with_fix("remove it first: tenon pose ASSET --remove " + name);
  }
  AssetEdit edit = PoseWriter::edit_of(AssetEdit::Kind::RenamePrim, named.path);
  edit.value = name;
  return std::vector<AssetEdit>{edit};
}

Result<std::vector<AssetEdit>> removal_edits(const PoseOfAsset& pose,
                                             const std::vector<std::string>& names) {
  std::vector<AssetEdit> edits;
  std::set<Path> removed;
  for (const std::string& name : names) {
    TENON_TRY(const physics::NamedPose named, named_pose(pose.poses, name));
    if (removed.insert(named.path).second) {
      edits.push_back(PoseWriter::edit_of(AssetEdit::Kind::RemovePrim, named.path));
    }
  }
  std::set<Path> scopes;
  for (const Path& path : removed) {
    scopes.insert(path.parent());
  }
  for (const Path& scope : scopes) {
    const std::vector<stage::Prim> children = pose.stage->prim(scope).children();
    const bool is_empty =
        scope.name() == structure::kNamedPosesScope &&
        std::all_of(children.begin(), children.end(),
                    [&](const stage::Prim& child) { return removed.contains(child.path()); });
    if (is_empty) {
      edits.push_back(PoseWriter::edit_of(AssetEdit::Kind::RemovePrim, scope));
    }
  }
  return edits;
}

}  // namespace tenon
