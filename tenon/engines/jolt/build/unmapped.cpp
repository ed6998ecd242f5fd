// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Properties of the scene that Jolt 5.0 does not support here; none is ignored silently.
#include <algorithm>

#include "tenon/engines/foreign_settings.h"
#include "tenon/engines/jolt/build/build.h"
#include "tenon/engines/scene_timeline.h"
#include "tenon/math/inertia.h"

namespace tenon::engines::jolt {
namespace {

using scene::Index;
using scene::Joint;

void report_body(Build& build, const scene::Body& body) {
  if (!(body.mass >= kMinMass)) {
    build.report(body.path, "physics:mass", "Jolt moves no massless body; 1e-9 kg is used");
  }
  const Vec3d moments = principal_inertia(body.inertia).moments;
  if (!(std::min({moments[0], moments[1], moments[2]}) >= kMinMoment)) {
    build.report(body.path, "physics:diagonalInertia",
                 "Jolt turns no body without inertia; principal moments are raised to 1e-13");
  }
}

void report_collider(Build& build, const scene::Collider& collider) {
  if (collider.contact_offset.has_value()) {
    build.report(collider.path, "contactOffset",
                 "Jolt looks for contacts of all shapes within one distance, 2 mm here");
  }
  if (collider.rest_offset.value_or(0) != 0) {
    build.report(collider.path, "restOffset", "shapes of Jolt touch where their surfaces are");
  }
  if (collider.settings.torsional_patch > 0 || collider.settings.min_torsional_patch > 0) {
    build.report(collider.path, "torsionalPatchRadius", "Jolt has friction against sliding alone");
  }
  if (collider.max_hull_vertices.has_value() &&
      collider.shape.kind == scene::ShapeKind::ConvexHull) {
    build.report(collider.path, "hullVertexLimit",
                 "Jolt bounds hulls by how far they miss points, not by corners");
  }
}

void report_material(Build& build, const scene::Material& material) {
  if (material.torsional_friction.value_or(0) > 0 || material.rolling_friction.value_or(0) > 0) {
    build.report(material.path, "torsionalFriction, rollingFriction",
                 "Jolt has friction against sliding alone");
  }
  if (material.compliance.stiffness > 0) {
    build.report(material.path, "compliantContactStiffness", "contacts of Jolt are hard");
  }
}

void report_joint(Build& build, const Joint& joint) {
  if (joint.kind == scene::JointKind::Distance && !joint.drives.empty()) {
    build.report(joint.path, "drive", "distances are bounded on Jolt, not driven");
  }
}

}  // namespace

void report_unmapped(Build& build) {
  for (const scene::Body& body : build.scene.bodies) {
    report_body(build, body);
  }
  for (const scene::Collider& collider : build.scene.colliders) {
    report_collider(build, collider);
  }
  for (const scene::Material& material : build.scene.materials) {
    report_material(build, material);
  }
  for (Index j = 0; j < build.scene.joints.size(); ++j) {
    if (build.model.joints[j].acts) {
      report_joint(build, build.scene.joints[j]);
    }
  }
  report_physx_settings(build.scene, build.model.not_mapped);
  report_mujoco_settings(build.scene, build.model.not_mapped);
  for (const scene::MujocoActuator& actuator : build.scene.actuators) {
    build.report(actuator.path, "", "an actuator of MuJoCo, which Jolt does not have");
  }
}

}  // namespace tenon::engines::jolt
