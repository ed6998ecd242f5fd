// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/joint_readings.h"

namespace tenon::engines {

JointState joint_state_between(const scene::Joint& joint, const scene::JointDofs& dofs,
                               const JointSide& side0, const JointSide& side1) {
  const Vec3d origin = side1.frame.position;
  const Vec3d of_side1 = side1.motion.velocity_at(origin);
  if (joint.kind == scene::JointKind::Distance) {
    const Vec3d apart = origin - side0.frame.position;
    const Vec3d of_anchor = side0.motion.velocity_at(side0.frame.position);
    return {{length(apart)}, {dot(normalized(apart), of_side1 - of_anchor)}};
  }
  const Vec3d linear = of_side1 - side0.motion.velocity_at(origin);
  const Vec3d angular = side1.motion.angular - side0.motion.angular;
  JointState state;
  state.position = coordinates_at(dofs, inverse(side0.frame) * side1.frame);
  for (const scene::FreeDof& dof : dofs.free) {
    const Vec3d axis = rotate(side0.frame.orientation, dof.axis0);
    state.velocity.push_back(is_angular(dof.dof) ? dot(axis, angular) : dot(axis, linear));
  }
  if (dofs.ball) {
    const Vec3d turn = rotate(conjugate(side0.frame.orientation), angular);
    state.velocity.insert(state.velocity.end(), turn.v.begin(), turn.v.end());
  }
  return state;
}

}  // namespace tenon::engines
