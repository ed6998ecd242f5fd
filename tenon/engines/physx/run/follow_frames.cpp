// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// An engine whose bodies have no coordinates would see a gap where the frame of a joint is
// somewhere else of a sudden, and pull the body there by the joint, which turns it. Bodies are
// moved along the trees, each with all that is behind it.
#include "tenon/engines/physx/run/follow_frames.h"

#include "tenon/math/transform.h"

namespace tenon::engines::physx {
namespace {

using scene::Index;

Pose side_of(const std::vector<BodyState>& states, const std::optional<Index>& body,
             const Pose& frame) {
  return body ? states[*body].pose * frame : frame;
}

void move_to(const Pose& pose, BodyState& state) {
  const Quatd turn = pose.orientation * conjugate(state.pose.orientation);
  state.linear_velocity = rotate(turn, state.linear_velocity);
  state.angular_velocity = rotate(turn, state.angular_velocity);
  state.pose = {pose.position, normalized(pose.orientation)};
}

}  // namespace

std::vector<BodyState> follow_joint_frames(const scene::PhysicsScene& scene, const Model& model,
                                           std::vector<BodyState> states) {
  const std::vector<BodyState> before = states;
  std::vector<char> moved(states.size(), 0);
  for (const Index body : model.forest.order) {
    const scene::ForestBody& place = model.forest.bodies[body];
    if (!place.joint || scene.bodies[body].kinematic) {
      continue;
    }
    const scene::Joint& joint = scene.joints[*place.joint];
    const auto& [old0, old1] = model.joint_frames[*place.joint];
    const bool follows = place.parent && moved[*place.parent] != 0;
    if (!follows && old0 == joint.frame0 && old1 == joint.frame1) {
      continue;
    }
    const Pose relative =
        inverse(side_of(before, joint.body0, old0)) * side_of(before, joint.body1, old1);
    const Pose pose =
        place.reversed
            ? side_of(states, joint.body1, joint.frame1) * inverse(relative) * inverse(joint.frame0)
            : side_of(states, joint.body0, joint.frame0) * relative * inverse(joint.frame1);
    move_to(pose, states[body]);
    moved[body] = 1;
  }
  return states;
}

}  // namespace tenon::engines::physx
