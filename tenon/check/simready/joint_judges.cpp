// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Requirements on joints, drives, mimics and articulations. Those of PhysX ask its schemas, which
// the validators of the release cannot import outside of Kit; here they are known. A drive stands
// for each axis that it is applied to: "angular" or "linear" of the two plain joints, the six axes
// of others.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "tenon/check/simready/judges.h"
#include "tenon/check/simready/reading.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/math/transform.h"
#include "tenon/stage/transform_at.h"

namespace tenon::check::simready {
namespace {

bool has_physx_mimic(const stage::Prim& prim) { return has_any_api(prim, "PhysxMimicJointAPI"); }

bool has_gain(const stage::Prim& prim, const std::string& axis, const char* property) {
  return number(prim, drive_name(axis, property)).value_or(0) != 0;
}

void visit_joints(const Judged& judged, Report& report,
                  void (*visit)(const stage::Prim& joint, Report& report)) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (is_moving_joint(prim)) {
      visit(prim, report);
    }
  }
}

}  // namespace

void judge_ba_001(const Judged& judged, Report& report) {
  const auto& prims = judged.stage.plain;
  if (std::none_of(prims.begin(), prims.end(), is_joint)) {
    return;
  }
  const auto roots = std::count_if(prims.begin(), prims.end(), [](const stage::Prim& prim) {
    return has_api(prim, "PhysicsArticulationRootAPI");
  });
  if (roots != 1) {
    report.at_root(judged, std::to_string(roots) + " prims have PhysicsArticulationRootAPI",
                   "apply it to one");
  }
}

void judge_jt_001(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.below_root) {
    if (!is_joint(prim)) {
      continue;
    }
    std::vector<Path> bodies = targets(prim, "physics:body0");
    const std::vector<Path> others = targets(prim, "physics:body1");
    bodies.insert(bodies.end(), others.begin(), others.end());
    const bool found = std::any_of(bodies.begin(), bodies.end(), [&](Path path) {
      return judged.stage.stage->prim(path).is_valid();
    });
    if (!found) {
      report.at(prim, "the joint connects nothing that is there", "name its bodies");
    }
  }
}

void judge_jt_002(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    for (const char* name : {"physics:body0", "physics:body1"}) {
      if (is_joint(prim) && !targets(prim, name).empty() && !target_prim(prim, name)) {
        report.at(prim, Token(name), "the body is not there", "correct the path");
      }
    }
  }
}

void judge_jt_003(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    for (const char* name : {"physics:body0", "physics:body1"}) {
      if (is_joint(prim) && targets(prim, name).size() > 1) {
        report.at(prim, Token(name), "more than one body", "name one");
      }
    }
  }
}

void judge_jt_art_002(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (!has_api(prim, "PhysicsArticulationRootAPI")) {
      continue;
    }
    for (stage::Prim at = prim.parent(); at && !at.is_pseudo_root(); at = at.parent()) {
      if (has_api(at, "PhysicsArticulationRootAPI")) {
        report.at(prim, "a root of an articulation below another one", "keep one of them");
        break;
      }
    }
  }
}

void judge_jt_art_003(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (has_api(prim, "PhysicsArticulationRootAPI") && has_api(prim, "PhysicsRigidBodyAPI") &&
        flag(prim, "physics:kinematicEnabled", false)) {
      report.at(prim, "the root of an articulation is a kinematic body",
                "hold it by a fixed joint instead");
    }
  }
}

void judge_jt_art_004(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (has_api(prim, "PhysicsArticulationRootAPI") && has_api(prim, "PhysicsRigidBodyAPI") &&
        !flag(prim, "physics:rigidBodyEnabled", true)) {
      report.at(prim, "the root of an articulation is a static body", "enable the body");
    }
  }
}

void judge_dj_001(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    const std::vector<std::string> axes = driven_axes(prim);
    const bool counts =
        has_physx_mimic(prim) && std::any_of(axes.begin(), axes.end(), [&](const auto& axis) {
          return has_gain(prim, axis, "stiffness") || has_gain(prim, axis, "damping");
        });
    if (!counts) {
      continue;
    }
    for (const std::string& axis : axes) {
      const double force = number(prim, drive_name(axis, "maxForce")).value_or(0);
      if (!(force > 0) || std::isinf(force)) {
        report.at(prim, Token(drive_name(axis, "maxForce")),
                  "the drive of a mimic has no usable effort", "give a finite one above 0");
      }
      constexpr double kTolerance = 0.01;
      for (const auto& [target, state] :
           {std::pair{"targetPosition", "position"}, std::pair{"targetVelocity", "velocity"}}) {
        const std::string of_state = "state:" + axis + ":physics:" + state;
        const auto wanted = number(prim, drive_name(axis, target));
        const auto now = number(prim, of_state);
        if (wanted && now && std::fabs(*wanted - *now) > kTolerance) {
          report.at(prim, Token(of_state), "the joint's state is not its drive's target",
                    "give both the same value");
        }
      }
    }
  }
}

void judge_dj_002(const Judged& judged, Report& report) {
  visit_joints(judged, report, [](const stage::Prim& joint, Report& out) {
    const std::string axis = is_prismatic(joint) ? "linear" : is_revolute(joint) ? "angular" : "";
    if (!axis.empty() && !has_api(joint, "PhysicsJointStateAPI:" + axis)) {
      out.at(joint, "the joint has no state", "apply PhysicsJointStateAPI:" + axis);
    }
  });
}

namespace {

/// Where a joint's frame is by one of its bodies; the rotation is of the frame without scale.
struct Frame {
  Vec3d origin;
  Quatd rotation = kIdentityRotation;
};

Mat3d without_scale(const Mat4d& matrix) {
  Mat3d linear = upper_left(matrix);
  for (auto& row : linear.m) {
    const double length = std::sqrt(row[0] * row[0] + row[1] * row[1] + row[2] * row[2]);
    for (double& one : row) {
      one = length > 0 ? one / length : 0;
    }
  }
  return linear;
}

Frame frame_by(const stage::Prim& joint, const char* body, const char* position,
               const char* rotation, stage::TransformCache& transforms, const Mat4d& state) {
  const Vec3f at = joint.attribute(Token(position)).get().get_or(Vec3f{});
  const Quatd turned =
      normalized(to_double(joint.attribute(Token(rotation)).get().get_or(Quatf{0, 0, 0, 1})));
  const Mat4d local = to_mat4(
      rotation_matrix(turned),
      Vec3d{{static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])}});
  const Mat4d world = state * local * transforms.local_to_world(target_prim(joint, body));
  return {Vec3d{{world[3][0], world[3][1], world[3][2]}}, rotation_of(without_scale(world))};
}

bool meet(const Frame& a, const Frame& b) {
  constexpr double kDistance = 1e-4;
  constexpr double kTurn = 1e-3;
  return length(a.origin - b.origin) <= kDistance &&
         std::fabs(dot(normalized(a.rotation), normalized(b.rotation))) >= 1 - kTurn;
}

Vec3d axis_of(const stage::Prim& joint) {
  const std::string axis = text(joint, "physics:axis");
  return axis == "Y" ? Vec3d{{0, 1, 0}} : axis == "Z" ? Vec3d{{0, 0, 1}} : Vec3d{{1, 0, 0}};
}

Mat4d state_of(const stage::Prim& joint) {
  constexpr double kRadians = 3.14159265358979323846 / 180;
  const bool turns = is_revolute(joint);
  const std::string api = turns ? "angular" : "linear";
  if (!has_api(joint, "PhysicsJointStateAPI:" + api)) {
    return Mat4d::identity();
  }
  const double value = number(joint, "state:" + api + ":physics:position").value_or(0);
  const Vec3d axis = axis_of(joint);
  if (!turns) {
    return translation_matrix(axis * value);
  }
  const double half = value * kRadians / 2;
  const Vec3d v = axis * std::sin(half);
  return to_mat4(rotation_matrix({v[0], v[1], v[2], std::cos(half)}));
}

}  // namespace

void judge_dj_003(const Judged& judged, Report& report) {
  stage::TransformCache transforms{stage::Time()};
  for (const stage::Prim& joint : judged.stage.with_shared) {
    if (!(is_revolute(joint) || is_prismatic(joint)) || !target_prim(joint, "physics:body0") ||
        !target_prim(joint, "physics:body1")) {
      continue;
    }
    const Frame second = frame_by(joint, "physics:body1", "physics:localPos1", "physics:localRot1",
                                  transforms, state_of(joint));
    const Frame first = frame_by(joint, "physics:body0", "physics:localPos0", "physics:localRot0",
                                 transforms, Mat4d::identity());
    if (!meet(second, first)) {
      report.at(joint, "the frames of the joint do not meet at its state",
                "correct its frames, or PhysicsJointStateAPI");
    }
  }
}

void judge_dj_004(const Judged& judged, Report& report) {
  visit_joints(judged, report, [](const stage::Prim& joint, Report& out) {
    const std::vector<std::string> axes = driven_axes(joint);
    const bool mimic = has_physx_mimic(joint);
    if (axes.empty() && !mimic && is_articulated(joint)) {
      out.at(joint, "nothing drives the joint and it follows none",
             "apply PhysicsDriveAPI, or PhysxMimicJointAPI");
    }
    for (const std::string& axis : axes) {
      const bool stiff = has_gain(joint, axis, "stiffness");
      if (mimic && (is_prismatic(joint) ? !stiff : stiff || has_gain(joint, axis, "damping"))) {
        out.at(joint, Token(drive_name(axis, "stiffness")),
               is_prismatic(joint) ? "PhysX needs stiffness to hold a sliding follower"
                                   : "the joint follows another one and has gains of its own",
               is_prismatic(joint) ? "give the drive stiffness" : "set them to 0");
      }
    }
  });
}

void judge_dj_005(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (has_api(prim, "PhysxJointAPI") &&
        !(number(prim, "physxJoint:maxJointVelocity").value_or(1) > 0)) {
      report.at(prim, Token("physxJoint:maxJointVelocity"), "the joint may not move at all",
                "give a velocity above 0");
    }
  }
}

void judge_dj_006(const Judged& judged, Report& report) {
  constexpr double kMost = 1e6;
  for (const stage::Prim& prim : judged.stage.with_shared) {
    const bool mimic = has_physx_mimic(prim);
    for (const std::string& axis : driven_axes(prim)) {
      const std::string name = drive_name(axis, "stiffness");
      const auto stiffness = authored_number_of(prim, name);
      if (mimic && !is_prismatic(prim)) {
        if (stiffness.value_or(0) != 0 ||
            authored_number_of(prim, drive_name(axis, "damping")).value_or(0) != 0) {
          report.at(prim, Token(name), "a joint that follows another one has gains",
                    "set them to 0");
        }
      } else if (!stiffness || (mimic && *stiffness == 0)) {
        report.at(prim, Token(name), "the drive's stiffness is not authored", "author it");
      } else if (!(*stiffness >= 0) || *stiffness > kMost) {
        report.at(prim, Token(name), "a stiffness of " + digits(*stiffness), "give 0 to 1e6");
      }
    }
  }
}

namespace {

struct Range {
  double low = 0;
  double high = 0;
};

std::optional<Range> limits_of(const stage::Prim& joint) {
  if (!joint || !(is_revolute(joint) || is_prismatic(joint))) {
    return std::nullopt;
  }
  const auto low = number(joint, "physics:lowerLimit");
  const auto high = number(joint, "physics:upperLimit");
  return low && high ? std::optional(Range{*low, *high}) : std::nullopt;
}

/// "" where a mimic of PhysX is right.
std::string fault_of_mimic(const stage::Prim& joint, const std::string& axis) {
  static const std::set<std::string> kKnown{"rotX",   "rotY", "rotZ", "transX", "transY",
                                            "transZ", "X",    "Y",    "Z"};
  if (!kKnown.contains(axis)) {
    return "there is no axis " + axis;
  }
  const std::string of = "physxMimicJoint:" + axis + ":";
  const std::vector<Path> leaders = targets(joint, of + "referenceJoint");
  if (leaders.size() != 1) {
    return "it follows " + std::to_string(leaders.size()) + " joints";
  }
  const double gearing = number(joint, of + "gearing").value_or(0);
  if (gearing == 0 || number(joint, of + "naturalFrequency").value_or(0) == 0) {
    return "its gearing or natural frequency is 0";
  }
  if (!is_authored(joint, of + "naturalFrequency") && !is_authored(joint, of + "gearing")) {
    return "it has neither gearing nor natural frequency";
  }
  const stage::Prim leader = joint.prim_at(leaders.front());
  const auto own = limits_of(joint);
  const auto others = limits_of(leader);
  if (!own || !others) {
    return "it or its leader has no limits";
  }
  if (flag(leader, "physics:excludeFromArticulation", false) ||
      flag(joint, "physics:excludeFromArticulation", false)) {
    return "it or its leader is no part of an articulation";
  }
  const double low = others->low * gearing;
  const double high = others->high * gearing;
  const bool inside =
      gearing < 0 ? low > own->low && own->high > high : low < own->high && own->low < high;
  return inside ? "" : "its limits do not meet those of its leader";
}

}  // namespace

void judge_dj_007(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    for (const std::string& axis : api_instances(prim, "PhysxMimicJointAPI")) {
      const std::string fault = fault_of_mimic(prim, axis);
      if (!fault.empty()) {
        report.at(prim, "of the joint that follows another one, " + fault,
                  "correct PhysxMimicJointAPI");
      }
    }
  }
}

namespace {

bool lacks(const Judged& judged, const char* api) {
  const auto& prims = judged.stage.plain;
  return std::any_of(prims.begin(), prims.end(), is_joint) &&
         std::none_of(prims.begin(), prims.end(),
                      [&](const stage::Prim& prim) { return has_api(prim, api); });
}

}  // namespace

void judge_dj_008(const Judged& judged, Report& report) {
  if (lacks(judged, "IsaacJointAPI")) {
    report.at_root(judged, "no joint has IsaacJointAPI", "apply it to the robot's joints");
  }
}

void judge_dj_009(const Judged& judged, Report& report) {
  if (lacks(judged, "IsaacLinkAPI")) {
    report.at_root(judged, "no link has IsaacLinkAPI", "apply it to the robot's links");
  }
}

void judge_dj_010(const Judged& judged, Report& report) {
  const stage::Prim root = judged.stage.root;
  if (!root) {
    report.at_root(judged, "there is no default prim", "author defaultPrim");
    return;
  }
  if (!has_api(root, "IsaacRobotAPI")) {
    return;
  }
  for (const char* name : {"isaac:physics:robotLinks", "isaac:physics:robotJoints"}) {
    const stage::Relationship list = root.relationship(Token(name));
    if (!list.is_authored()) {
      report.at(root, std::string(name) + " is missing", "author it");
      continue;
    }
    for (const stage::SpecSite& site : list.spec_stack()) {
      const auto* edit = site.spec->get<layer::ListOp<Path>>(layer::fields::targetPaths);
      if (edit != nullptr && edit->is_explicit) {
        report.at(root, Token(name), "the list hides those of weaker layers", "prepend instead");
        break;
      }
    }
  }
}

namespace {

using Pair = std::pair<Path, Path>;

/// Bodies joined into groups; true where two were in one group before.
class Groups {
 public:
  bool join(Path a, Path b) {
    const Path first = head(a);
    const Path second = head(b);
    above_[first] = second;
    return first == second;
  }

 private:
  Path head(Path path) {
    Path at = path;
    while (above_.contains(at) && !(above_.at(at) == at)) {
      at = above_.at(at);
    }
    if (!(path == at)) {
      above_[path] = at;  // shorter for the next time
    }
    return at;
  }

  std::map<Path, Path> above_;
};

}  // namespace

void judge_dj_011(const Judged& judged, Report& report) {
  std::set<Pair> joined;
  Groups groups;
  for (const stage::Prim& prim : judged.stage.plain) {
    if (!is_articulated(prim)) {
      continue;
    }
    const stage::Prim first = target_prim(prim, "physics:body0");
    const stage::Prim second = target_prim(prim, "physics:body1");
    if (!first || !second) {
      continue;
    }
    const Pair pair = std::minmax(first.path(), second.path());
    if (!joined.insert(pair).second) {
      report.at(prim, "another joint connects the same two bodies", "keep one");
    } else if (groups.join(pair.first, pair.second)) {
      report.at(prim, "the joint closes a loop", "author physics:excludeFromArticulation = true");
    }
  }
}

}  // namespace tenon::check::simready
