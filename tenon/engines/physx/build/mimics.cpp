// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// PhysX 5.1 has no joints that follow others. What comes nearest is a fixed tendon: a spring on the
// sum of coordinates of one tree, solved with the joints themselves. Its length is follower -
// multiplier * leader - offset, and it rests at 0. A tendon goes from link to link, so coordinates
// on its way that have no part in it get the coefficient 0.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "tenon/engines/physx/build/build.h"

namespace tenon::engines::physx {
namespace {

using scene::Index;

constexpr double kRigid = 1e8;  ///< [N m/rad or N/m] stiffer than any tree resolves in a step

struct Share {
  double coefficient = 0;
  px::PxArticulationAxis::Enum axis = px::PxArticulationAxis::eTWIST;
};

/// Links from `link` up to the root, itself first.
std::vector<px::PxArticulationLink*> way_up(px::PxArticulationLink* link) {
  std::vector<px::PxArticulationLink*> way;
  while (link != nullptr) {
    way.push_back(link);
    px::PxArticulationJointReducedCoordinate* joint = link->getInboundJoint();
    link = joint == nullptr ? nullptr : &joint->getParentArticulationLink();
  }
  return way;
}

std::optional<px::PxArticulationAxis::Enum> free_axis(
    const px::PxArticulationJointReducedCoordinate& joint) {
  for (int axis = 0; axis < px::PxArticulationAxis::eCOUNT; ++axis) {
    const auto candidate = static_cast<px::PxArticulationAxis::Enum>(axis);
    if (joint.getMotion(candidate) != px::PxArticulationMotion::eLOCKED) {
      return candidate;
    }
  }
  return std::nullopt;
}

/// The tendon joints from below `top` down to `link`, made where they are missing.
using TendonJoints = std::map<px::PxArticulationLink*, px::PxArticulationTendonJoint*>;
bool reach(px::PxArticulationFixedTendon& tendon, px::PxArticulationLink* link,
           const std::map<px::PxArticulationLink*, Share>& shares, TendonJoints& made) {
  std::vector<px::PxArticulationLink*> missing;
  for (px::PxArticulationLink* at : way_up(link)) {
    if (made.contains(at)) {
      break;
    }
    missing.push_back(at);
  }
  std::reverse(missing.begin(), missing.end());
  for (px::PxArticulationLink* at : missing) {
    px::PxArticulationJointReducedCoordinate& joint = *at->getInboundJoint();
    const auto share = shares.find(at);
    const auto axis = share != shares.end() ? std::optional(share->second.axis) : free_axis(joint);
    if (!axis.has_value()) {
      return false;
    }
    const double coefficient = share != shares.end() ? share->second.coefficient : 0;
    made[at] = tendon.createTendonJoint(made.at(&joint.getParentArticulationLink()), *axis,
                                        to_px(coefficient), to_px(coefficient), at);
  }
  return true;
}

px::PxArticulationLink* common_link(px::PxArticulationLink* a, px::PxArticulationLink* b) {
  const std::vector<px::PxArticulationLink*> way = way_up(a);
  for (px::PxArticulationLink* at : way_up(b)) {
    if (std::find(way.begin(), way.end(), at) != way.end()) {
      return at;
    }
  }
  return nullptr;
}

/// Inertia that a coordinate moves, of the child alone: what a soft mimic is tuned by.
double inertia_of(const JointMap& map) {
  const px::PxArticulationLink& child = map.link_joint->getChildArticulationLink();
  if (map.axis == px::PxArticulationAxis::eX) {
    return child.getMass();
  }
  const px::PxTransform in_mass =
      child.getCMassLocalPose().getInverse() * map.link_joint->getChildPose();
  const px::PxVec3 axis = in_mass.q.getBasisVector0();
  const px::PxVec3 moments = child.getMassSpaceInertiaTensor();
  const px::PxVec3 arm = in_mass.p - axis * in_mass.p.dot(axis);
  return axis.multiply(axis).dot(moments) + child.getMass() * arm.magnitudeSquared() +
         map.link_joint->getArmature(map.axis);
}

void set_stiffness(const scene::Mimic& mimic, const JointMap& follower, const JointMap& leader,
                   double count, px::PxArticulationFixedTendon& tendon) {
  double stiffness = kRigid;
  double damping = 0;
  if (mimic.natural_frequency > 0) {
    const double inertia =
        1 / (1 / inertia_of(follower) + mimic.multiplier * mimic.multiplier / inertia_of(leader));
    stiffness = inertia * mimic.natural_frequency * mimic.natural_frequency;
    damping = 2 * mimic.damping_ratio * mimic.natural_frequency * inertia;
  }
  tendon.setStiffness(to_px(stiffness * count));
  tendon.setDamping(to_px(damping * count));
  tendon.setLimitStiffness(0);
}

std::string_view why_not(const scene::Mimic& mimic, const JointMap& follower,
                         const JointMap& leader) {
  const bool powers =
      std::any_of(mimic.higher.begin(), mimic.higher.end(), [](double c) { return c != 0; });
  if (powers) {
    return "tendons of PhysX are linear; the higher powers have no place";
  }
  const auto fits = [](const JointMap& map) {
    return map.role == JointRole::Reduced && !map.dofs.free.empty();
  };
  if (!fits(follower) || !fits(leader) || follower.tree != leader.tree) {
    return "PhysX couples coordinates of one articulation only";
  }
  return "";
}

void add_mimic(Build& build, Index index, const scene::Mimic& mimic) {
  const JointMap& follower = build.model.joints[index];
  const JointMap& leader = build.model.joints[mimic.leader];
  const Path& path = build.scene.joints[index].path;
  if (const std::string_view why = why_not(mimic, follower, leader); !why.empty()) {
    build.report(path, mimic.schema, std::string(why));
    return;
  }
  px::PxArticulationLink* child = &follower.link_joint->getChildArticulationLink();
  px::PxArticulationLink* leading = &leader.link_joint->getChildArticulationLink();
  px::PxArticulationLink* top = common_link(&follower.link_joint->getParentArticulationLink(),
                                            &leader.link_joint->getParentArticulationLink());
  px::PxArticulationFixedTendon* tendon =
      build.model.trees[follower.tree].articulation->createFixedTendon();
  TendonJoints made;
  made[top] = tendon->createTendonJoint(nullptr, px::PxArticulationAxis::eTWIST, 0, 0, top);
  const std::map<px::PxArticulationLink*, Share> shares{
      {child, {1, follower.axis}}, {leading, {-mimic.multiplier, leader.axis}}};
  if (!reach(*tendon, child, shares, made) || !reach(*tendon, leading, shares, made)) {
    build.report(path, mimic.schema,
                 "PhysX couples coordinates across joints with a coordinate of their own only");
    return;
  }
  tendon->setOffset(to_px(-mimic.offset));
  tendon->setRestLength(0);
  tendon->setLimitParameters(px::PxArticulationTendonLimit(-PX_MAX_F32, PX_MAX_F32));
  set_stiffness(mimic, follower, leader, static_cast<double>(made.size() - 1), *tendon);
}

}  // namespace

void add_mimics(Build& build) {
  for (Index j = 0; j < build.scene.joints.size(); ++j) {
    const scene::Joint& joint = build.scene.joints[j];
    for (const scene::Mimic& mimic : joint.mimics) {
      if (joint.enabled) {
        add_mimic(build, j, mimic);
      }
    }
  }
}

}  // namespace tenon::engines::physx
