// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "tenon/engines/mujoco/build/build.h"
#include "tenon/engines/mujoco/build/surfaces.h"
#include "tenon/engines/mujoco/soft_defaults.h"

// MuJoCo applies the joints of one body in order, each axis carried by the ones before: exactly the
// chain of JointDofs. When the MuJoCo child is body0, the chain runs backwards with turned axes,
// and the coordinates stay those of body1 relative to body0.
namespace tenon::engines::mujoco {
namespace {

using scene::kUnlimited;

constexpr double kOpenEnd = 1e10;  // MuJoCo's largest number; "no bound" of a one-sided limit

void set_limit(mjsJoint* joint, const scene::FreeDof& dof, const scene::MujocoSoftness& softness,
               double time_step) {
  const bool limited = dof.lower > -kUnlimited || dof.upper < kUnlimited;
  joint->limited = limited ? mjLIMITED_TRUE : mjLIMITED_FALSE;
  if (!limited) {
    return;
  }
  joint->range[0] = std::max(dof.lower, -kOpenEnd);
  joint->range[1] = std::min(dof.upper, kOpenEnd);
  soften_limit(time_step, softness, joint->solref_limit, joint->solimp_limit);
}

void set_spring(Build& build, const scene::Joint& joint, const scene::LimitSpring& spring,
                mjsJoint* target) {
  if (spring.stiffness > 0) {
    build.soft_bounds.push_back({target, nullptr, spring.stiffness, spring.damping});
    return;
  }
  const std::array<double, 2> solref = contact_solref(spring.restitution, build.time_step);
  std::copy(solref.begin(), solref.end(), target->solref_limit);
  std::copy(kSolimp.begin(), kSolimp.end(), target->solimp_limit);  // that of contacts
  if (spring.bounce_threshold > 0) {
    build.report(joint.path, "physxLimit:bounceThreshold",
                 "slow impacts on the bound rebound like fast ones");
  }
}

void set_passive(const Build& build, mjsJoint* target, const scene::Joint& joint) {
  target->armature = joint.armature;
  target->frictionloss = joint.friction;
  target->damping[0] = joint.damping;
  target->stiffness[0] = joint.stiffness;
  target->springref = joint.spring_reference;
  if (joint.friction > 0) {
    harden_friction(build.time_step, joint.parts.mujoco, target->solref_friction,
                    target->solimp_friction);
  }
}

}  // namespace

void add_chain(Build& build, scene::Index index, mjsBody* child, const Pose& joint_in_child,
               bool reversed) {
  const scene::Joint& joint = build.scene.joints[index];
  const scene::JointDofs& dofs = build.dofs[index];
  std::vector<mjsJoint*>& made = build.joints[index];
  made.assign(dofs.free.size(), nullptr);
  // Rotations turn about the origin of frame 1; seen from frame 0 that is the locked offset.
  const Vec3d anchor = transform_point(joint_in_child, reversed ? dofs.locked.position : Vec3d{});
  const auto add_ball = [&] {
    mjsJoint* ball = mjs_addJoint(child, nullptr);
    mjs_setName(ball->element, (joint.path.str() + ".ball").c_str());
    ball->type = mjJNT_BALL;
    write_vector(ball->pos, anchor);
    ball->limited = mjLIMITED_FALSE;
    set_passive(build, ball, joint);
    build.balls[index] = ball;
  };
  if (dofs.ball && reversed) {
    add_ball();
  }
  for (std::size_t n = 0; n < dofs.free.size(); ++n) {
    const std::size_t i = reversed ? dofs.free.size() - 1 - n : n;
    const scene::FreeDof& dof = dofs.free[i];
    mjsJoint* target = mjs_addJoint(child, nullptr);
    const std::string name = joint.path.str() + "." + std::string(dof_name(dof.dof));
    mjs_setName(target->element, name.c_str());
    target->type = is_angular(dof.dof) ? mjJNT_HINGE : mjJNT_SLIDE;
    write_vector(target->pos, anchor);
    const Vec3d axis = rotate(joint_in_child.orientation, reversed ? -dof.axis0 : dof.axis1);
    write_vector(target->axis, axis);
    const bool refused = build.refused.contains(joint.path);
    refused ? build.report(joint.path, "limit:" + std::string(dof_name(dof.dof)),
                           "MuJoCo refuses the limits; skipped")
            : set_limit(target, dof, joint.parts.mujoco, build.time_step);
    if (const scene::LimitSpring* spring = limit_spring(joint, dof.dof)) {
      set_spring(build, joint, *spring, target);
    }
    set_passive(build, target, joint);
    made[i] = target;
  }
  if (dofs.ball && !reversed) {
    add_ball();
  }
}

mjsJoint* scalar_joint(const Build& build, scene::Index joint, scene::Dof dof) {
  const scene::JointDofs& dofs = build.dofs[joint];
  for (std::size_t i = 0; i < build.joints[joint].size(); ++i) {
    if (dofs.free[i].dof == dof) {
      return build.joints[joint][i];
    }
  }
  return nullptr;
}

void add_joints(Build& build) {
  for (const scene::Index index : build.plan.forest.order) {
    const scene::ForestBody& link = build.plan.forest.bodies[index];
    if (!link.joint) {
      continue;
    }
    const scene::Joint& joint = build.scene.joints[*link.joint];
    add_chain(build, *link.joint, build.bodies[index], link.reversed ? joint.frame0 : joint.frame1,
              link.reversed);
  }
}

}  // namespace tenon::engines::mujoco
