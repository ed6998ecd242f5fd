// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/applied_forces.h"

#include "tenon/scene/motion/joint_motion.h"

namespace tenon::engines {

Wrench constant_wrench(const scene::Body& body, const Pose& pose) {
  Wrench total;
  for (const scene::BodyForce& push : body.settings.forces) {
    const auto turned = [&](const Vec3d& v) {
      return push.body_axes ? rotate(pose.orientation, v) : v;
    };
    Vec3d force = turned(push.force);
    Vec3d torque = turned(push.torque);
    if (push.acceleration) {
      force = force * body.mass;
      const Vec3d own = rotate(conjugate(pose.orientation), torque);
      torque = rotate(pose.orientation, own * body.inertia);
    }
    const Vec3d arm = rotate(pose.orientation, push.point - body.center_of_mass);
    total.force += force;
    total.torque += torque + cross(arm, force);
  }
  return total;
}

Wrench effort_wrench(const scene::Joint& joint, const scene::JointDofs& dofs, const Pose& frame0,
                     const Pose& frame1, std::span<const double> efforts) {
  Wrench wrench;
  if (joint.kind == scene::JointKind::Distance) {
    wrench.force = normalized(frame1.position - frame0.position) * efforts.front();
    return wrench;
  }
  const scene::JointMotion motion = joint_motion(dofs, frame0, frame1);
  const std::size_t slides = motion.slides.size();  // which come first
  for (std::size_t i = 0; i < efforts.size(); ++i) {
    wrench.force += i < slides ? motion.slides[i] * efforts[i] : Vec3d{};
    wrench.torque += i < slides ? Vec3d{} : motion.turns[i - slides] * efforts[i];
  }
  return wrench;
}

}  // namespace tenon::engines
