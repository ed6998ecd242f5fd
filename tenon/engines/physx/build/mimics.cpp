// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// PhysX 5.1 has no joints that follow others. What comes nearest within an articulation is a fixed
// tendon: a spring on the sum of coordinates of one tree, solved with the joints themselves; others
// are constraints (Coupling). Its length is a multiple of follower - multiplier * leader - offset,
// and it rests at 0.
#include <algorithm>
#include <cmath>
#include <utility>

#include "tenon/engines/physx/build/tendons.h"
#include "tenon/math/mimic_law.h"

namespace tenon::engines::physx {
namespace {

using scene::Index;

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

/// Without a natural frequency, or with one whose spring is over within a step.
bool is_rigid(const scene::Mimic& mimic, double time_step) {
  return !(mimic.natural_frequency > 0) || mimic.natural_frequency * time_step > 1;
}

/// The coefficient of the follower in the tendon. With a leader's above 1, as of a hinge that turns
/// many radians for each metre of its slide, a rigid tendon goes beyond what PhysX's floats hold. A
/// soft one keeps 1: what PhysX makes of its stiffness is not the same at other scales.
double scale_of(const scene::Mimic& mimic, double time_step) {
  return is_rigid(mimic, time_step) ? 1 / std::max(1.0, std::fabs(mimic.multiplier)) : 1;
}

void set_stiffness(const scene::Mimic& mimic, const JointMap& follower, const JointMap& leader,
                   double time_step, FixedTendonLaw& law) {
  law.stiffness = kRigidTendon * std::max({1.0, inertia_of(follower), inertia_of(leader)});
  if (!is_rigid(mimic, time_step)) {
    const double inertia =
        1 / (1 / inertia_of(follower) + mimic.multiplier * mimic.multiplier / inertia_of(leader));
    law.stiffness = inertia * mimic.natural_frequency * mimic.natural_frequency;
    law.damping = 2 * mimic.damping_ratio * mimic.natural_frequency * inertia;
  }
  // PhysX shares a stiffness out among the joints.
  const auto count = static_cast<double>(law.parts.size());
  law.tendon->setStiffness(to_px(law.stiffness * count));
  law.tendon->setDamping(to_px(law.damping * count));
  law.tendon->setLimitStiffness(0);
}

/// Tendons are linear sums of coordinates of one articulation.
bool fits_a_tendon(const scene::Mimic& mimic, const JointMap& follower, const JointMap& leader) {
  const auto fits = [](const JointMap& map) {
    return map.role == JointRole::Reduced && !map.dofs.free.empty();
  };
  return mimic_is_linear(mimic) && fits(follower) && fits(leader) && follower.tree == leader.tree;
}

void add_coupling(Build& build, Index index, const scene::Mimic& mimic) {
  const Path& path = build.scene.joints[index].path;
  std::string_view why = Coupling::why_not(build.scene, build.model, index, mimic);
  if (why.empty()) {
    Coupling* made =
        build.model.owned.add_coupling(std::make_unique<Coupling>(build.scene, index, mimic));
    build.model.couplings.push_back(made);
    if (build.model.owned.add(made->connect(*build.runtime.physics, build.model)) != nullptr) {
      return;
    }
    build.model.couplings.pop_back();
    why = "PhysX refuses the constraint";
  }
  build.report(path, mimic.schema, std::string(why));
}

void add_mimic(Build& build, Index index, const scene::Mimic& mimic) {
  const JointMap& follower = build.model.joints[index];
  const JointMap& leader = build.model.joints[mimic.leader];
  const Path& path = build.scene.joints[index].path;
  if (!fits_a_tendon(mimic, follower, leader)) {
    add_coupling(build, index, mimic);
    return;
  }
  const double scale = scale_of(mimic, build.model.time_step);
  FixedTendonLaw law = make_fixed_tendon(
      build, follower.tree, {{index, scale}, {mimic.leader, -mimic.multiplier * scale}});
  if (law.tendon == nullptr) {
    build.report(path, mimic.schema,
                 "PhysX couples coordinates across joints with a coordinate of their own only");
    return;
  }
  law.offset = -mimic.offset * scale;
  law.tendon->setOffset(to_px(law.offset));
  law.tendon->setRestLength(0);
  law.tendon->setLimitParameters(px::PxArticulationTendonLimit(-PX_MAX_F32, PX_MAX_F32));
  set_stiffness(mimic, follower, leader, build.model.time_step, law);
  build.model.tendons.push_back(std::move(law));
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
