// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "cli/explain.h"
#include "tenon/base/rounded_text.h"
#include "tenon/math/angle.h"
#include "tenon/physics/joint_limits.h"

namespace tenon::cli {
namespace {

using physics::Dof;
using physics::Joint;

Json number(double value) { return std::isfinite(value) ? Json(value + 0.0) : Json(nullptr); }

std::string text(const Json& value) {
  if (value.is_null()) {
    return "unlimited";
  }
  return rounded_text(value.get<double>());
}

Json pose_json(const Pose& pose) {
  const double sign = pose.orientation.w < 0 ? -1 : 1;
  const Quatd& q = pose.orientation;
  return {{"position", {pose.position[0], pose.position[1], pose.position[2]}},
          {"orientation", {sign * q.w, sign * q.x, sign * q.y, sign * q.z}}};
}

Pose in_world(const physics::PhysicsScene& scene, const std::optional<physics::Index>& body,
              const Pose& frame) {
  return body ? scene.bodies[*body].pose * frame : frame;
}

Json side_json(const Explained& explained, const std::optional<physics::Index>& body, Path target,
               const Pose& frame) {
  const bool moved = body && !(explained.scene.bodies[*body].path == target);
  Json side = {{"target", target.empty() ? Json(nullptr) : Json(target.str())},
               {"body", body ? Json(explained.scene.bodies[*body].path.str()) : Json(nullptr)},
               {"frame", pose_json(frame)},
               {"world", pose_json(in_world(explained.scene, body, frame))}};
  side["why"] =
      target.empty() ? "no target: the world, localPos and localRot are world values [S-85]"
      : moved        ? "the target is not a body: that of the nearest body above, with the "
                       "transform between [S-86]"
      : body         ? "localPos through the whole matrix of the body, its scale included [S-83]"
                     : "the target has no body: the world, with its transform [S-86]";
  return side;
}

Json drive_json(const Joint& joint, Dof dof) {
  for (const physics::Drive& drive : joint.drives) {
    if (drive.dof == dof) {
      return {{"type", drive.acceleration ? "acceleration" : "force"},
              {"stiffness", drive.stiffness},
              {"damping", drive.damping},
              {"maxForce", number(drive.max_force)},
              {"targetPosition", drive.target_position},
              {"targetVelocity", drive.target_velocity},
              {"source", drive.source.str()}};
    }
  }
  return nullptr;
}

Json dofs_json(const Joint& joint) {
  Json rows = Json::array();
  for (const Dof dof : {Dof::TransX, Dof::TransY, Dof::TransZ, Dof::RotX, Dof::RotY, Dof::RotZ}) {
    const bool locked = physics::is_locked(joint, dof);
    const physics::Limit limit = physics::limit_of(joint, dof);
    rows.push_back({{"dof", physics::dof_name(dof)},
                    {"angular", physics::is_angular(dof)},
                    {"locked", locked},
                    {"lower", locked ? Json(nullptr) : number(limit.lower)},
                    {"upper", locked ? Json(nullptr) : number(limit.upper)},
                    {"drive", drive_json(joint, dof)}});
  }
  return rows;
}

std::string vector_text(const Json& v) {
  return "(" + text(v[0]) + ", " + text(v[1]) + ", " + text(v[2]) + ")";
}

std::string side_text(const Json& side, const char* name) {
  std::string line = std::string("    ") + name + ": ";
  line += side["body"].is_null() ? std::string("world") : side["body"].get<std::string>();
  if (!side["target"].is_null() && side["target"] != side["body"]) {
    line += " (named: " + side["target"].get<std::string>() + ")";
  }
  return line + ", frame at " + vector_text(side["frame"]["position"]) + " m, in the world at " +
         vector_text(side["world"]["position"]) + " m\n      " + side["why"].get<std::string>() +
         "\n";
}

std::string bound_text(const Json& value, bool angular) {
  return value.is_null() ? "unlimited"
                         : text(Json(value.get<double>() * (angular ? kDegreesPerRadian : 1))) +
                               (angular ? " deg" : " m");
}

std::string dof_text(const Json& row) {
  const bool angular = row["angular"].get<bool>();
  std::string line = "    " + row["dof"].get<std::string>() + "  ";
  if (row["locked"].get<bool>()) {
    line += "locked";
  } else if (row["lower"].is_null() && row["upper"].is_null()) {
    line += "free";
  } else {
    line += bound_text(row["lower"], angular) + " to " + bound_text(row["upper"], angular);
  }
  const Json& drive = row["drive"];
  if (!drive.is_null()) {
    line += ", " + drive["type"].get<std::string>() + " drive from " +
            drive["source"].get<std::string>() + ": stiffness " + text(drive["stiffness"]) +
            ", damping " + text(drive["damping"]) +
            (drive["maxForce"].is_null() ? ", no force limit"
                                         : ", at most " + text(drive["maxForce"])) +
            ", to " + text(drive["targetPosition"]) + " at " + text(drive["targetVelocity"]) +
            " (SI, radians)";
  }
  return line + "\n";
}

std::string breaking_text(const Json& force, const Json& torque) {
  if (force.is_null() && torque.is_null()) {
    return "never breaks";
  }
  return "breaks above " + (force.is_null() ? "" : text(force) + " N") +
         (force.is_null() || torque.is_null() ? "" : " or ") +
         (torque.is_null() ? "" : text(torque) + " N m");
}

}  // namespace

Json joint_json(const Explained& explained, physics::Index index) {
  const physics::PhysicsScene& scene = explained.scene;
  const Joint& joint = scene.joints[index];
  const Pose relative = inverse(in_world(scene, joint.body0, joint.frame0)) *
                        in_world(scene, joint.body1, joint.frame1);
  Json row = {{"type", physics::joint_kind_name(joint.kind)},
              {"enabled", joint.enabled},
              {"side0", side_json(explained, joint.body0, joint.target0, joint.frame0)},
              {"side1", side_json(explained, joint.body1, joint.target1, joint.frame1)},
              {"start",
               {{"distance", length(relative.position)},
                {"angle", length(rotation_vector(normalized(relative.orientation)))}}},
              {"dofs", dofs_json(joint)}};
  row["collisionEnabled"] = joint.collision_enabled;
  row["breakForce"] = number(joint.break_force);
  row["breakTorque"] = number(joint.break_torque);
  Json role = nullptr;
  if (joint.articulation) {
    const physics::Articulation& articulation = scene.articulations[*joint.articulation];
    bool loop = false;
    for (const physics::Index other : articulation.loop_joints) {
      loop = loop || other == index;
    }
    role = {{"path", articulation.path.str()}, {"loop", loop}};
  }
  row["articulation"] = role;
  return row;
}

std::string joint_text(const Json& joint) {
  std::string text_of = "  joint: " + joint["type"].get<std::string>() +
                        (joint["enabled"].get<bool>() ? "\n" : ", disabled [S-91]\n");
  text_of += side_text(joint["side0"], "body0") + side_text(joint["side1"], "body1");
  text_of += "    at the start frame 1 is " + text(joint["start"]["distance"]) + " m and " +
             text(Json(joint["start"]["angle"].get<double>() * kDegreesPerRadian)) +
             " deg away from frame 0\n";
  for (const Json& row : joint["dofs"]) {
    text_of += dof_text(row);
  }
  text_of += joint["collisionEnabled"].get<bool>()
                 ? "    the jointed sides may touch [S-92]\n"
                 : "    the jointed sides do not touch, where both are named [S-92]\n";
  text_of += "    " + breaking_text(joint["breakForce"], joint["breakTorque"]) + " [S-93]\n";
  if (!joint["articulation"].is_null()) {
    text_of += "    of the articulation " + joint["articulation"]["path"].get<std::string>() +
               (joint["articulation"]["loop"].get<bool>() ? ", closes a loop [S-111]\n" : "\n");
  }
  return text_of;
}

}  // namespace tenon::cli
