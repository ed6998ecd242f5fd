// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/glb/glb_parts.h"

namespace tenon::glb {
namespace {

template <class T>
GltfJson or_null(const std::optional<T>& value) {
  return value ? GltfJson(*value) : GltfJson(nullptr);
}

GltfJson finite_or_null(double value) {
  return is_finite(value) ? GltfJson(value) : GltfJson(nullptr);
}

GltfJson pose_numbers(const Pose& pose) {
  const Vec3d& p = pose.position;
  const Quatd& q = pose.orientation;
  return {p[0], p[1], p[2], q.x, q.y, q.z, q.w};
}

GltfJson body_extras(const view::ViewBody& body) {
  return {{"path", body.path.str()},
          {"mass", body.mass},
          {"centerOfMass", numbers_of(body.center_of_mass)},
          {"principalAxes", numbers_of(body.principal_axes)},
          {"principalMoments", numbers_of(body.principal_moments)},
          {"inertiaBox", numbers_of(body.inertia_box)},
          {"kinematic", body.kinematic},
          {"enabled", body.enabled},
          {"articulation", or_null(body.articulation)}};
}

GltfJson joint_extras(const view::ViewJoint& joint) {
  GltfJson limits = GltfJson::array();
  for (const view::ViewLimit& limit : joint.limits) {
    limits.push_back({{"dof", scene::dof_name(limit.dof)},
                      {"lower", or_null(limit.lower)},
                      {"upper", or_null(limit.upper)}});
  }
  GltfJson drives = GltfJson::array();
  for (const scene::Drive& drive : joint.drives) {
    drives.push_back({{"dof", scene::dof_name(drive.dof)},
                      {"stiffness", drive.stiffness},
                      {"damping", drive.damping},
                      {"maxForce", finite_or_null(drive.max_force)},
                      {"targetPosition", drive.target_position},
                      {"targetVelocity", drive.target_velocity}});
  }
  constexpr const char* kAxes[] = {"X", "Y", "Z"};
  return {{"path", joint.path.str()},
          {"kind", scene::joint_kind_name(joint.kind)},
          {"body0", or_null(joint.body0)},
          {"body1", or_null(joint.body1)},
          {"frame0", pose_numbers(joint.frame0)},
          {"frame1", pose_numbers(joint.frame1)},
          {"axis", kAxes[static_cast<int>(joint.axis)]},
          {"limits", std::move(limits)},
          {"drives", std::move(drives)},
          {"articulation", or_null(joint.articulation)},
          {"enabled", joint.enabled},
          {"closesLoop", joint.closes_loop}};
}

GltfJson collider_extras(const view::ViewCollider& collider) {
  return {{"path", collider.path.str()},
          {"body", or_null(collider.body)},
          {"kind", collider.kind},
          {"approximation", collider.approximation},
          {"enabled", collider.enabled},
          {"volume", finite_or_null(collider.volume)},
          {"sourceVolume", or_null(collider.source_volume)},
          {"hullGap", or_null(collider.hull_gap)}};
}

GltfJson camera_extras(const view::ViewCamera& camera) {
  return {{"path", camera.path.str()},
          {"body", or_null(camera.body)},
          {"pose", pose_numbers(camera.pose)},
          {"halfWidth", camera.half_width},
          {"halfHeight", camera.half_height}};
}

template <class T, class Write>
GltfJson list_of(const std::vector<T>& values, Write write) {
  GltfJson list = GltfJson::array();
  for (const T& value : values) {
    list.push_back(write(value));
  }
  return list;
}

}  // namespace

GltfJson numbers_of(const Vec3d& v) { return {v[0], v[1], v[2]}; }
GltfJson numbers_of(const Quatd& q) { return {q.x, q.y, q.z, q.w}; }

GltfJson scene_extras(const view::ViewScene& view) {
  GltfJson extras;
  extras["version"] = 1;
  extras["up"] = numbers_of(view.up);
  extras["bodies"] = list_of(view.bodies, body_extras);
  extras["joints"] = list_of(view.joints, joint_extras);
  extras["colliders"] = list_of(view.colliders, collider_extras);
  extras["articulations"] =
      list_of(view.articulations, [](const view::ViewArticulation& articulation) -> GltfJson {
        return {{"path", articulation.path.str()},
                {"fixedBase", articulation.fixed_base},
                {"links", articulation.links},
                {"joints", articulation.joints}};
      });
  extras["cameras"] = list_of(view.cameras, camera_extras);
  GltfJson pairs = GltfJson::array();
  for (const auto& [a, b] : view.filtered_pairs) {
    const auto number = [](Index body) { return body == view::kWorld ? -1L : long{body}; };
    pairs.push_back(GltfJson::array({number(a), number(b)}));
  }
  extras["filteredPairs"] = std::move(pairs);
  extras["notes"] = list_of(view.notes, [](const view::ViewNote& note) -> GltfJson {
    return {{"prim", note.prim.str()}, {"what", note.what}};
  });
  return extras;
}

}  // namespace tenon::glb
