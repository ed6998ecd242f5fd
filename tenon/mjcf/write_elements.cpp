// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mjcf/write_elements.h"

#include "tenon/engines/mujoco/model.h"

namespace tenon::mjcf {

mjsSite& named_site(mjSpec& spec, mjsBody* body, const std::string& name, const Pose& pose) {
  if (mjsElement* known = mjs_findElement(&spec, mjOBJ_SITE, name.c_str())) {
    return *mjs_asSite(known);
  }
  mjsSite& made = *mjs_addSite(body, nullptr);
  mjs_setName(made.element, name.c_str());
  engines::mujoco::write_vector(made.pos, pose.position);
  engines::mujoco::write_quaternion(made.quat, normalized(pose.orientation));
  return made;
}

std::string joint_element(mjSpec& spec, const scene::Joint& joint) {
  const bool ball = joint.kind == scene::JointKind::Spherical;
  if (!ball && joint.kind != scene::JointKind::Revolute &&
      joint.kind != scene::JointKind::Prismatic) {
    return {};
  }
  std::string name =
      joint.path.str() + "." + (ball ? std::string("ball") : std::string(dof_name(joint.dof())));
  return mjs_findElement(&spec, mjOBJ_JOINT, name.c_str()) == nullptr ? std::string() : name;
}

}  // namespace tenon::mjcf
