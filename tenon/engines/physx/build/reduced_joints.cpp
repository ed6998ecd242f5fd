// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A joint of a tree turns about, or slides along, the x axis of its frames, so both frames are
// turned until x is the joint's axis; where the tree goes the other way through the joint, until x
// is its opposite, and the coordinate keeps its sign. PhysX bounds speeds at 100 rad/s unless told
// otherwise.
#include <algorithm>

#include "tenon/engines/physx/build/build.h"
#include "tenon/engines/physx/run/drives.h"

namespace tenon::engines::physx {
namespace {

using scene::Index;
using scene::Joint;

constexpr float kMostSpeed = 1e6F;

void set_frames(const Joint& joint, JointMap& map) {
  const scene::JointDofs& dofs = map.dofs;
  Vec3d axis = dofs.free.empty() ? Vec3d{{1, 0, 0}} : dofs.free.front().axis0;
  if (map.reversed) {
    axis = -axis;
  }
  const Pose turned{{}, dofs.ball ? kIdentityRotation : rotation_from_x(axis)};
  const px::PxTransform side0 = to_px(joint.frame0 * turned);
  const px::PxTransform side1 = to_px(joint.frame1 * inverse(dofs.locked) * turned);
  map.link_joint->setParentPose(map.reversed ? side1 : side0);
  map.link_joint->setChildPose(map.reversed ? side0 : side1);
}

/// The world is an anchor link at the joint's own frame.
void set_anchor(const Joint& joint, JointMap& map) {
  const bool to_world = map.reversed ? !joint.body1.has_value() : !joint.body0.has_value();
  if (!to_world) {
    return;
  }
  const Pose anchor = map.reversed ? joint.frame1 : joint.frame0;
  const px::PxTransform in_anchor = to_px(anchor).getInverse() * map.link_joint->getParentPose();
  map.link_joint->setParentPose(in_anchor);
}

void set_ball(JointMap& map) {
  map.link_joint->setJointType(px::PxArticulationJointType::eSPHERICAL);
  for (const auto axis : {px::PxArticulationAxis::eTWIST, px::PxArticulationAxis::eSWING1,
                          px::PxArticulationAxis::eSWING2}) {
    map.link_joint->setMotion(axis, px::PxArticulationMotion::eFREE);
  }
}

void set_coordinate(Build& build, Index index, JointMap& map) {
  const Joint& joint = build.scene.joints[index];
  const scene::FreeDof& free = map.dofs.free.front();
  const bool angular = is_angular(free.dof);
  map.axis = angular ? px::PxArticulationAxis::eTWIST : px::PxArticulationAxis::eX;
  px::PxArticulationJointReducedCoordinate& made = *map.link_joint;
  made.setJointType(angular ? px::PxArticulationJointType::eREVOLUTE_UNWRAPPED
                            : px::PxArticulationJointType::ePRISMATIC);
  const bool bounded = free.lower > -scene::kUnlimited || free.upper < scene::kUnlimited;
  made.setMotion(map.axis,
                 bounded ? px::PxArticulationMotion::eLIMITED : px::PxArticulationMotion::eFREE);
  if (bounded) {
    made.setLimitParams(map.axis, limits_of_coordinate(free));
  }
  write_drives(joint, map, build.model.time_step);
  made.setArmature(map.axis, to_px(joint.armature));
}

}  // namespace

void set_reduced_joints(Build& build) {
  for (Index j = 0; j < build.model.joints.size(); ++j) {
    JointMap& map = build.model.joints[j];
    if (map.role != JointRole::Reduced) {
      continue;
    }
    const Joint& joint = build.scene.joints[j];
    if (map.dofs.ball) {
      set_ball(map);
    } else if (map.dofs.free.empty()) {
      map.link_joint->setJointType(px::PxArticulationJointType::eFIX);
    } else {
      set_coordinate(build, j, map);
    }
    set_frames(joint, map);
    set_anchor(joint, map);
    map.link_joint->setFrictionCoefficient(0);
    map.link_joint->setMaxJointVelocity(
        to_px(std::min(joint.velocity_limit, static_cast<double>(kMostSpeed))));
  }
}

}  // namespace tenon::engines::physx
