// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>
#include <vector>

#include "tenon/answers/explain.h"
#include "tenon/answers/or_null.h"
#include "tenon/scene/joint_forest.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::answers {
namespace {

using scene::Dof;
using scene::Joint;

Json pose_json(const Pose& pose) {
  const double sign = pose.orientation.w < 0 ? -1 : 1;
  const Quatd& q = pose.orientation;
  return {{"position", {pose.position[0], pose.position[1], pose.position[2]}},
          {"orientation", {sign * q.w, sign * q.x, sign * q.y, sign * q.z}}};
}

Pose in_world(const scene::PhysicsScene& scene, const std::optional<scene::Index>& body,
              const Pose& frame) {
  return body ? scene.bodies[*body].pose * frame : frame;
}

Json side_json(const Explained& explained, const std::optional<scene::Index>& body, Path target,
               const Pose& frame) {
  const bool moved = body && !(explained.scene.bodies[*body].path == target);
  Json side = {{"target", or_null(target)},
               {"body", body ? Json(explained.scene.bodies[*body].path.str()) : Json(nullptr)},
               {"frame", pose_json(frame)},
               {"world", pose_json(in_world(explained.scene, body, frame))}};
  side["why"] = target.empty()
                    ? "no target: the world, localPos and localRot are world values [S-85]"
                : moved ? "the target is not a body: that of the nearest body above, with the "
                          "transform between [S-86]"
                : body  ? "localPos through the whole matrix of the body, its scale included [S-83]"
                        : "the target has no body: the world, with its transform [S-86]";
  return side;
}

Json drive_json(const Joint& joint, Dof dof) {
  for (const scene::Drive& drive : joint.drives) {
    if (drive.dof == dof) {
      return {{"type", drive.acceleration ? "acceleration" : "force"},
              {"stiffness", drive.stiffness},
              {"damping", drive.damping},
              {"maxForce", finite_or_null(drive.max_force)},
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
    const bool locked = scene::is_locked(joint, dof);
    const scene::Limit limit = scene::limit_of(joint, dof);
    rows.push_back({{"dof", scene::dof_name(dof)},
                    {"angular", scene::is_angular(dof)},
                    {"locked", locked},
                    {"lower", locked ? Json(nullptr) : finite_or_null(limit.lower)},
                    {"upper", locked ? Json(nullptr) : finite_or_null(limit.upper)},
                    {"drive", drive_json(joint, dof)}});
  }
  return rows;
}

/// Of a spherical joint, how far its axis may tilt toward each of the other two axes (S-96).
Json cones_json(const Joint& joint) {
  if (joint.kind != scene::JointKind::Spherical) {
    return nullptr;
  }
  constexpr const char* kAxes[] = {"X", "Y", "Z"};
  const auto axis = static_cast<std::size_t>(joint.axis);
  return {{"axis", kAxes[axis]},
          {"toward",
           {{{"axis", kAxes[(axis + 1) % 3]},
             {"property", "physics:coneAngle0Limit"},
             {"limit", finite_or_null(joint.cone_angle0)}},
            {{"axis", kAxes[(axis + 2) % 3]},
             {"property", "physics:coneAngle1Limit"},
             {"limit", finite_or_null(joint.cone_angle1)}}}}};
}

bool contains(const std::vector<scene::Index>& list, scene::Index index) {
  return std::find(list.begin(), list.end(), index) != list.end();
}

}  // namespace

Json joint_json(const Explained& explained, scene::Index index) {
  const scene::PhysicsScene& scene = explained.scene;
  const Joint& joint = scene.joints[index];
  const Pose relative = inverse(in_world(scene, joint.body0, joint.frame0)) *
                        in_world(scene, joint.body1, joint.frame1);
  Json row = {{"type", scene::joint_kind_name(joint.kind)},
              {"enabled", joint.enabled},
              {"side0", side_json(explained, joint.body0, joint.target0, joint.frame0)},
              {"side1", side_json(explained, joint.body1, joint.target1, joint.frame1)},
              {"start",
               {{"distance", length(relative.position)},
                {"angle", length(rotation_vector(normalized(relative.orientation)))}}},
              {"dofs", dofs_json(joint)},
              {"cones", cones_json(joint)}};
  row["collisionEnabled"] = joint.collision_enabled;
  row["breakForce"] = finite_or_null(joint.break_force);
  row["breakTorque"] = finite_or_null(joint.break_torque);
  const bool loop = scene::joint_forest(scene).joints[index] == scene::ForestRole::Loop;
  row["loop"] = loop;
  row["articulation"] = nullptr;
  for (const scene::Articulation& articulation : scene.articulations) {
    if (contains(articulation.joints, index) || contains(articulation.loop_joints, index)) {
      row["articulation"] = {{"path", articulation.path.str()}, {"loop", loop}};
    }
  }
  return row;
}

}  // namespace tenon::answers
