// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// The locked degrees of freedom of a joint are held by the Jolt constraint made for it: fixed,
// hinge, slider, point, swing and twist for cones, distance, and six degrees of freedom for all
// others. Bounds are not part of them, except for cones and distances (laws.cpp).
#include <algorithm>
#include <array>
#include <cmath>

#include "tenon/engines/jolt/build/build.h"
#include "tenon/scene/joint_freedom.h"
//
#include <Jolt/Physics/Constraints/DistanceConstraint.h>
#include <Jolt/Physics/Constraints/FixedConstraint.h>
#include <Jolt/Physics/Constraints/HingeConstraint.h>
#include <Jolt/Physics/Constraints/PointConstraint.h>
#include <Jolt/Physics/Constraints/SixDOFConstraint.h>
#include <Jolt/Physics/Constraints/SliderConstraint.h>
#include <Jolt/Physics/Constraints/SwingTwistConstraint.h>

namespace tenon::engines::jolt {
namespace {

using scene::Dof;
using scene::Index;
using scene::Joint;

/// Both frames, so that they are alike where all free coordinates are zero.
struct Sides {
  JPH::Body* body0;
  JPH::Body* body1;
  Pose frame0;
  Pose frame1;
};

Vec3d axis_at(const Pose& frame, const Vec3d& axis) { return rotate(frame.orientation, axis); }

/// A unit vector across `axis`, the same for both frames.
Vec3d any_across(const Vec3d& axis) {
  const std::size_t least = std::abs(axis[0]) < 0.6 ? 0 : 1;
  Vec3d other;
  other[least] = 1;
  return normalized(cross(axis, other));
}

JPH::TwoBodyConstraint* make_fixed(const Sides& sides) {
  JPH::FixedConstraintSettings wanted;
  wanted.mSpace = JPH::EConstraintSpace::LocalToBodyCOM;
  wanted.mPoint1 = to_jolt_place(sides.frame0.position);
  wanted.mAxisX1 = to_jolt(axis_at(sides.frame0, {{1, 0, 0}}));
  wanted.mAxisY1 = to_jolt(axis_at(sides.frame0, {{0, 1, 0}}));
  wanted.mPoint2 = to_jolt_place(sides.frame1.position);
  wanted.mAxisX2 = to_jolt(axis_at(sides.frame1, {{1, 0, 0}}));
  wanted.mAxisY2 = to_jolt(axis_at(sides.frame1, {{0, 1, 0}}));
  return wanted.Create(*sides.body0, *sides.body1);
}

JPH::TwoBodyConstraint* make_hinge(const Sides& sides, const Vec3d& axis) {
  const Vec3d normal = any_across(axis);
  JPH::HingeConstraintSettings wanted;
  wanted.mSpace = JPH::EConstraintSpace::LocalToBodyCOM;
  wanted.mPoint1 = to_jolt_place(sides.frame0.position);
  wanted.mHingeAxis1 = to_jolt(axis_at(sides.frame0, axis));
  wanted.mNormalAxis1 = to_jolt(axis_at(sides.frame0, normal));
  wanted.mPoint2 = to_jolt_place(sides.frame1.position);
  wanted.mHingeAxis2 = to_jolt(axis_at(sides.frame1, axis));
  wanted.mNormalAxis2 = to_jolt(axis_at(sides.frame1, normal));
  return wanted.Create(*sides.body0, *sides.body1);
}

JPH::TwoBodyConstraint* make_slider(const Sides& sides, const Vec3d& axis) {
  const Vec3d normal = any_across(axis);
  JPH::SliderConstraintSettings wanted;
  wanted.mSpace = JPH::EConstraintSpace::LocalToBodyCOM;
  wanted.mPoint1 = to_jolt_place(sides.frame0.position);
  wanted.mSliderAxis1 = to_jolt(axis_at(sides.frame0, axis));
  wanted.mNormalAxis1 = to_jolt(axis_at(sides.frame0, normal));
  wanted.mPoint2 = to_jolt_place(sides.frame1.position);
  wanted.mSliderAxis2 = to_jolt(axis_at(sides.frame1, axis));
  wanted.mNormalAxis2 = to_jolt(axis_at(sides.frame1, normal));
  return wanted.Create(*sides.body0, *sides.body1);
}

JPH::TwoBodyConstraint* make_point(const Sides& sides) {
  JPH::PointConstraintSettings wanted;
  wanted.mSpace = JPH::EConstraintSpace::LocalToBodyCOM;
  wanted.mPoint1 = to_jolt_place(sides.frame0.position);
  wanted.mPoint2 = to_jolt_place(sides.frame1.position);
  return wanted.Create(*sides.body0, *sides.body1);
}

// The first angle is a tilt of the axis toward the next one, the second toward the one after.
JPH::TwoBodyConstraint* make_cone(Build& build, const Joint& joint, const Sides& sides) {
  const auto axis = static_cast<std::size_t>(joint.axis);
  Vec3d twist;
  twist[axis] = 1;
  Vec3d plane;
  plane[(axis + 1) % 3] = 1;
  JPH::SwingTwistConstraintSettings wanted;
  wanted.mSpace = JPH::EConstraintSpace::LocalToBodyCOM;
  wanted.mPosition1 = to_jolt_place(sides.frame0.position);
  wanted.mTwistAxis1 = to_jolt(axis_at(sides.frame0, twist));
  wanted.mPlaneAxis1 = to_jolt(axis_at(sides.frame0, plane));
  wanted.mPosition2 = to_jolt_place(sides.frame1.position);
  wanted.mTwistAxis2 = to_jolt(axis_at(sides.frame1, twist));
  wanted.mPlaneAxis2 = to_jolt(axis_at(sides.frame1, plane));
  wanted.mPlaneHalfConeAngle = to_jolt(std::clamp(joint.cone_angle0, 0.0, M_PI));
  wanted.mNormalHalfConeAngle = to_jolt(std::clamp(joint.cone_angle1, 0.0, M_PI));
  wanted.mTwistMinAngle = -JPH::JPH_PI;
  wanted.mTwistMaxAngle = JPH::JPH_PI;
  if (!joint.limit_springs.empty()) {
    build.report(joint.path, "limit", "cones of Jolt are hard");
  }
  return wanted.Create(*sides.body0, *sides.body1);
}

const scene::LimitSpring* spring_of(const Joint& joint, Dof dof) {
  const auto found = std::find_if(joint.limit_springs.begin(), joint.limit_springs.end(),
                                  [&](const scene::LimitSpring& s) { return s.dof == dof; });
  return found == joint.limit_springs.end() ? nullptr : &*found;
}

JPH::TwoBodyConstraint* make_distance(const Joint& joint, const Sides& sides) {
  constexpr double kFar = 1e9;  // [m]
  const scene::Limit bounds = distance_limit(joint);
  JPH::DistanceConstraintSettings wanted;
  wanted.mSpace = JPH::EConstraintSpace::LocalToBodyCOM;
  wanted.mPoint1 = to_jolt_place(sides.frame0.position);
  wanted.mPoint2 = to_jolt_place(sides.frame1.position);
  wanted.mMaxDistance = to_jolt(std::min(bounds.upper, kFar));
  wanted.mMinDistance = to_jolt(std::clamp(bounds.lower, 0.0, std::min(bounds.upper, kFar)));
  const scene::LimitSpring* spring = spring_of(joint, Dof::Distance);
  if (spring != nullptr && spring->stiffness > 0) {
    wanted.mLimitsSpringSettings.mMode = JPH::ESpringMode::StiffnessAndDamping;
    wanted.mLimitsSpringSettings.mStiffness = to_jolt(spring->stiffness);
    wanted.mLimitsSpringSettings.mDamping = to_jolt(spring->damping);
  }
  return wanted.Create(*sides.body0, *sides.body1);
}

JPH::TwoBodyConstraint* make_six(const scene::JointDofs& dofs, const Sides& sides) {
  using Six = JPH::SixDOFConstraintSettings;
  Six wanted;
  wanted.mSpace = JPH::EConstraintSpace::LocalToBodyCOM;
  wanted.mPosition1 = to_jolt_place(sides.frame0.position);
  wanted.mAxisX1 = to_jolt(axis_at(sides.frame0, {{1, 0, 0}}));
  wanted.mAxisY1 = to_jolt(axis_at(sides.frame0, {{0, 1, 0}}));
  wanted.mPosition2 = to_jolt_place(sides.frame1.position);
  wanted.mAxisX2 = to_jolt(axis_at(sides.frame1, {{1, 0, 0}}));
  wanted.mAxisY2 = to_jolt(axis_at(sides.frame1, {{0, 1, 0}}));
  wanted.mSwingType = JPH::ESwingType::Pyramid;
  std::array<bool, Six::EAxis::Num> free{};
  for (const scene::FreeDof& dof : dofs.free) {
    free[static_cast<std::size_t>(dof.dof)] = true;
  }
  for (std::size_t i = 0; i < free.size(); ++i) {
    const bool turns = i >= Six::EAxis::NumTranslation;
    if (!free[i] && !(turns && dofs.ball)) {
      wanted.MakeFixedAxis(static_cast<Six::EAxis>(i));
    }
  }
  return wanted.Create(*sides.body0, *sides.body1);
}

std::size_t turns_of(const scene::JointDofs& dofs) {
  const auto turns = std::count_if(dofs.free.begin(), dofs.free.end(),
                                   [](const scene::FreeDof& dof) { return is_angular(dof.dof); });
  return static_cast<std::size_t>(turns) + (dofs.ball ? 3U : 0U);
}

JPH::TwoBodyConstraint* make_holder(Build& build, Index index) {
  const Joint& joint = build.scene.joints[index];
  const scene::JointDofs& dofs = build.model.joints[index].dofs;
  Sides sides{&side_body(build.model, joint.body0), &side_body(build.model, joint.body1),
              side_frame(build.scene, joint.body0, joint.frame0),
              side_frame(build.scene, joint.body1, joint.frame1)};
  if (joint.kind == scene::JointKind::Distance) {
    const scene::Limit bounds = distance_limit(joint);
    const bool bounded = bounds.lower > 0 || bounds.upper < scene::kUnlimited;
    return bounded ? make_distance(joint, sides) : nullptr;
  }
  sides.frame1 = sides.frame1 * inverse(dofs.locked);
  const std::size_t turns = turns_of(dofs);
  const std::size_t slides = dofs.count() - turns;
  if (turns + slides == 0) {
    return make_fixed(sides);
  }
  if (turns == 3 && slides == 0) {
    const bool cone = joint.kind == scene::JointKind::Spherical &&
                      std::min(joint.cone_angle0, joint.cone_angle1) < M_PI;
    return cone ? make_cone(build, joint, sides) : make_point(sides);
  }
  if (turns == 1 && slides == 0) {
    return make_hinge(sides, dofs.free.front().axis0);
  }
  if (turns == 0 && slides == 1) {
    return make_slider(sides, dofs.free.front().axis0);
  }
  return turns + slides < 6 ? make_six(dofs, sides) : nullptr;
}

// Of joints that may break, and of all where reactions are read.
void measure(Build& build, Index index) {
  const Joint& joint = build.scene.joints[index];
  JointMap& map = build.model.joints[index];
  if (!build.options.outputs.reactions && !can_break(joint)) {
    return;
  }
  map.measured =
      new MeasuredHolder(map.holder, side_frame(build.scene, joint.body1, joint.frame1).position);
  build.set_steps(*map.measured, false);
}

}  // namespace

JPH::Body& side_body(const Model& model, const std::optional<Index>& body) {
  return body.has_value() ? *model.bodies[*body] : JPH::Body::sFixedToWorld;
}

Pose side_frame(const scene::PhysicsScene& scene, const std::optional<Index>& body,
                const Pose& frame) {
  const Vec3d center = body.has_value() ? scene.bodies[*body].center_of_mass : Vec3d{};
  return {frame.position - center, frame.orientation};
}

void add_holders(Build& build) {
  for (Index j = 0; j < build.scene.joints.size(); ++j) {
    JointMap& map = build.model.joints[j];
    if (!map.acts || map.tree != nullptr) {
      continue;
    }
    map.holder = make_holder(build, j);
    if (map.holder != nullptr) {
      build.set_steps(*map.holder, false);
      measure(build, j);
    }
  }
}

}  // namespace tenon::engines::jolt
