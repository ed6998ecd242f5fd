// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/start_coordinates.h"

#include <cmath>
#include <cstdio>

#include "tenon/scene/start_coordinate.h"

namespace tenon::engines {
namespace {

using scene::Index;
using scene::PhysicsScene;

constexpr double kNoticedGap = 1e-4;   // [m]
constexpr double kNoticedTurn = 1e-3;  // [rad]

// Frames that do not meet are brought together by the coordinates of the tree (S-90).
void report_gap(const scene::Joint& joint, const Pose& wanted, const Pose& possible,
                Diagnostics& diagnostics) {
  const double gap = length(wanted.position - possible.position);
  const double turn =
      length(rotation_vector(normalized(conjugate(possible.orientation) * wanted.orientation)));
  if (gap <= kNoticedGap && turn <= kNoticedTurn) {
    return;
  }
  char text[128];
  std::snprintf(
      text, sizeof(text),
      "the joint's frames are %.3g mm and %.3g degrees apart at the start; the bodies are "
      "moved together",
      gap * 1000, turn * 180 / M_PI);
  diagnostics.add({Severity::Warning, "joint.frames-apart", text, joint.path.str(), "",
                   "correct localPos and localRot, or the poses of the bodies"});
}

}  // namespace

std::vector<double> start_coordinates(const PhysicsScene& scene, const scene::Joint& joint,
                                      const scene::JointDofs& dofs, Diagnostics& diagnostics) {
  const Pose relative = relative_frames(scene, joint);
  std::vector<double> coordinates = coordinates_at(dofs, relative);
  report_gap(joint, relative, relative_pose_at(dofs, coordinates), diagnostics);
  if (joint.initial_position.has_value() && dofs.free.size() == 1 && !dofs.ball) {
    coordinates[0] = *joint.initial_position;
  }
  return coordinates;
}

void report_lost_energy(const PhysicsScene& scene, const scene::FittedVelocities& fitted,
                        Diagnostics& diagnostics) {
  for (const scene::LostEnergy& loss : fitted.losses) {
    diagnostics.add({Severity::Warning, "joint.velocities-apart", scene::words_of(loss),
                     scene.joints[loss.joint].path.str(), "",
                     "give the bodies velocities with which the joint's frames stay together"});
  }
  for (const Index body : fitted.unused) {
    diagnostics.add({Severity::Warning, "articulation.link-velocity",
                     "the velocity of the link does not act: links of an articulation begin with "
                     "the velocities of their joints",
                     scene.bodies[body].path.str(), "",
                     "author the velocities of the joints with PhysicsJointStateAPI"});
  }
}

}  // namespace tenon::engines
