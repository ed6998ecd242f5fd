// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Jolt has no joint coordinates: bodies stand side by side, and constraints hold them. So that all
// begin where engines with coordinates would put them, each body is placed by the joint that the
// scene's forest hangs it on; frames that are apart are brought together and reported (S-90), and
// an authored joint position replaces what the poses say. Velocities are those that the joints make
// of the bodies' own (fit_velocities).
#include "tenon/engines/jolt/build/build.h"
#include "tenon/engines/start_coordinates.h"
#include "tenon/scene/motion/fit_velocities.h"

namespace tenon::engines::jolt {
namespace {

using scene::Index;
using scene::Joint;

constexpr double kPlaced = 1e-9;  // [m, rad] nearer frames are not moved

bool acts(const Build& build, Index joint) {
  const Joint& source = build.scene.joints[joint];
  return source.enabled && (build.forest.joints[joint] != scene::ForestRole::None ||
                            source.kind == scene::JointKind::Distance);
}

bool is_at(const Pose& one, const Pose& other) {
  return length(one.position - other.position) < kPlaced &&
         length(rotation_vector(normalized(conjugate(one.orientation) * other.orientation))) <
             kPlaced;
}

void place_body(Build& build, Index body) {
  const scene::ForestBody& place = build.forest.bodies[body];
  if (!place.joint.has_value() || build.scene.bodies[body].kinematic) {
    return;
  }
  const Joint& joint = build.scene.joints[*place.joint];
  const scene::JointDofs& dofs = build.model.joints[*place.joint].dofs;
  if (!place.parent.has_value() && dofs.count() == 0) {
    return;  // what is fixed to the world stays where it stands
  }
  const Pose relative =
      relative_pose_at(dofs, start_coordinates(build.scene, joint, dofs, build.diagnostics));
  const Pose parent = place.parent.has_value() ? build.states[*place.parent].pose : Pose{};
  const Pose placed = place.reversed
                          ? parent * joint.frame1 * inverse(relative) * inverse(joint.frame0)
                          : parent * joint.frame0 * relative * inverse(joint.frame1);
  if (!is_at(placed, build.states[body].pose)) {
    build.states[body].pose = placed;
  }
}

std::vector<scene::JointDofs> dofs_of(const Model& model) {
  std::vector<scene::JointDofs> dofs;
  dofs.reserve(model.joints.size());
  for (const JointMap& map : model.joints) {
    dofs.push_back(map.dofs);
  }
  return dofs;
}

}  // namespace

void plan(Build& build, Begin begin) {
  build.forest = joint_forest(build.scene);
  const std::vector<scene::FreeRotations> rotations = wanted_rotations(build.scene);
  build.model.joints.resize(build.scene.joints.size());
  for (Index j = 0; j < build.scene.joints.size(); ++j) {
    build.model.joints[j].dofs = joint_dofs(build.scene.joints[j], rotations[j]);
    build.model.joints[j].acts = acts(build, j);
  }
  build.states = states_at_start(build.scene, build.model.time_step);
  if (begin == Begin::Middle) {
    for (Index b = 0; b < build.states.size(); ++b) {
      const scene::Body& body = build.scene.bodies[b];
      build.states[b] = {body.pose, body.linear_velocity, body.angular_velocity};
    }
  } else {
    for (const Index body : build.forest.order) {
      place_body(build, body);
    }
  }
  if (scene::anything_moves(build.scene, build.states)) {
    const auto links =
        begin == Begin::Start ? scene::LinkVelocities::OfJoints : scene::LinkVelocities::Own;
    const scene::FittedVelocities fitted =
        fit_velocities(build.scene, build.forest, dofs_of(build.model), build.states, links);
    build.states = fitted.bodies;
    report_lost_energy(build.scene, fitted, build.diagnostics);
  }
}

}  // namespace tenon::engines::jolt
