// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/joint_dofs.h"

#include <gtest/gtest.h>

#include "tenon/scene/physics_scene.h"

namespace tenon::scene {
namespace {

struct RoundTrip {
  const char* name;
  std::vector<Limit> limits;  // of a D6 joint
  std::vector<double> coordinates;
};

TEST(JointDofs, CoordinatesSurviveTheWayThroughAPose) {
  const Limit lock_x{Dof::RotX, 1, -1};
  const Limit lock_y{Dof::RotY, 1, -1};
  const Limit lock_z{Dof::RotZ, 1, -1};
  const Limit no_slide_z{Dof::TransZ, 1, -1};
  const Limit hold_x{Dof::RotX, 0.3, 0.3};
  const Limit hold_y{Dof::RotY, 0.3, 0.3};
  const Limit hold_z{Dof::RotZ, 0.3, 0.3};
  const Limit limited_x{Dof::RotX, -3, 3};
  const RoundTrip cases[] = {
      {"one turn beyond a quarter", {lock_x, lock_z}, {0.1, 0.2, 0.3, 2.5}},
      {"two turns x y", {lock_z}, {0.1, 0.2, 0.3, -2.5, 2.8}},
      {"two turns y z", {lock_x}, {0.1, 0.2, 0.3, 2.2, -2.7}},
      {"two turns x z", {lock_y}, {0.1, 0.2, 0.3, 2.2, -2.7}},
      {"held x", {hold_x}, {0.1, 0.2, 0.3, 2.2, -2.7}},
      {"held y", {hold_y}, {0.1, 0.2, 0.3, 2.2, -2.7}},
      {"held z", {hold_z}, {0.1, 0.2, 0.3, 2.2, -2.7}},
      {"held x, turn z", {hold_x, lock_y}, {0.1, 0.2, 0.3, 2.7}},
      {"held z, turn x", {hold_z, lock_y}, {0.1, 0.2, 0.3, 2.7}},
      {"three turns", {limited_x}, {0.1, 0.2, 0.3, 2.2, -1.2, 2.9}},
      {"ball", {no_slide_z}, {0.1, 0.2, 0.4, -0.5, 1.2}},
  };
  for (const RoundTrip& c : cases) {
    Joint joint;
    joint.kind = JointKind::D6;
    joint.limits = c.limits;
    const JointDofs dofs = joint_dofs(joint);
    ASSERT_EQ(dofs.count(), c.coordinates.size()) << c.name;
    const std::vector<double> back = coordinates_at(dofs, relative_pose_at(dofs, c.coordinates));
    for (std::size_t i = 0; i < back.size(); ++i) {
      EXPECT_NEAR(back[i], c.coordinates[i], 1e-9) << c.name << " " << i;
    }
  }
}

TEST(JointDofs, EllipticConeComesBackToo) {
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
    Joint joint;
    joint.kind = JointKind::Spherical;
    joint.axis = axis;
    joint.cone_angle0 = 0.5;
    joint.cone_angle1 = 1;
    const JointDofs dofs = joint_dofs(joint);
    const std::vector<double> wanted{0.4, -0.9, 2.5};
    const std::vector<double> back = coordinates_at(dofs, relative_pose_at(dofs, wanted));
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(back[i], wanted[i], 1e-9);
    }
  }
}

TEST(JointDofs, LimitApiIntersectsTheJointsOwnLimits) {
  Joint joint;
  joint.kind = JointKind::Revolute;
  joint.axis = Axis::Y;
  joint.lower = -1;
  joint.upper = 1;
  joint.limits = {{Dof::RotY, -0.5, 2}, {Dof::RotZ, 1, -1}};
  const JointDofs dofs = joint_dofs(joint);
  ASSERT_EQ(dofs.free.size(), 1u);
  EXPECT_EQ(dofs.free[0].lower, -0.5);
  EXPECT_EQ(dofs.free[0].upper, 1);
}

struct DistanceCase {
  double lower;
  double upper;
  double expected_lower;
  double expected_upper;
};

TEST(JointDofs, DistanceLimits) {
  const double open = kUnlimited;
  for (const DistanceCase& c :
       {DistanceCase{-1, -1, -open, open}, DistanceCase{0.1, 0.5, 0.1, 0.5},
        DistanceCase{-open, 2, -open, 2}, DistanceCase{5, 1, 1, 1}, DistanceCase{3, -1, 3, open}}) {
    Joint joint;
    joint.kind = JointKind::Distance;
    joint.lower = c.lower;
    joint.upper = c.upper;
    const Limit limit = distance_limit(joint);
    EXPECT_EQ(limit.lower, c.expected_lower);
    EXPECT_EQ(limit.upper, c.expected_upper);
  }
}

}  // namespace
}  // namespace tenon::scene
