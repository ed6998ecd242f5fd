// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bake/euler.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tenon/math/quaternion.h"
#include "tenon/math/transform.h"

namespace tenon::bake {
namespace {

constexpr double kRadians = 3.14159265358979323846 / 180;

Vec3d unit(std::size_t i) {
  Vec3d v;
  v[i] = 1;
  return v;
}

/// First about the first axis named, then about the next: quaternions multiply from the left.
Mat3d rotation_by(const std::string& order, const Vec3d& degrees) {
  Quatd q = kIdentityRotation;
  for (const char c : order) {
    const auto axis = static_cast<std::size_t>(c - 'X');
    q = rotation_about(unit(axis), degrees[axis] * kRadians) * q;
  }
  return upper_left(pose_matrix({{}, q}));
}

double difference(const Mat3d& a, const Mat3d& b) {
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      most = std::fmax(most, std::fabs(a[i][j] - b[i][j]));
    }
  }
  return most;
}

TEST(Euler, EveryOrderGivesTheAnglesBack) {
  const Vec3d degrees{{20, -35, 110}};
  for (const char* order : {"XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"}) {
    const Mat3d rotation = rotation_by(order, degrees);
    const auto found = euler_degrees(rotation, "xformOp:rotate" + std::string(order), degrees);
    ASSERT_TRUE(found.has_value());
    EXPECT_LT(length(*found - degrees), 1e-9) << order;
  }
}

TEST(Euler, TurnsBeyondAHalfOneGoOn) {
  const Vec3d before{{350, 5, 0}};
  const auto found = euler_degrees(rotation_by("XYZ", {{370, 6, 1}}), "xformOp:rotateXYZ", before);
  ASSERT_TRUE(found.has_value());
  EXPECT_LT(length(*found - Vec3d{{370, 6, 1}}), 1e-9);
}

TEST(Euler, WhereTwoAxesAreOneTheRotationIsStillExact) {
  for (const double middle : {90.0, -90.0}) {
    const Mat3d rotation = rotation_by("XYZ", {{30, middle, 50}});
    const auto found = euler_degrees(rotation, "xformOp:rotateXYZ", {});
    ASSERT_TRUE(found.has_value());
    EXPECT_LT(difference(rotation_by("XYZ", *found), rotation), 1e-7);
  }
}

TEST(Euler, OneAxisGivesOnlyItsOwnTurns) {
  const auto found = euler_degrees(rotation_by("Y", {{0, 200, 0}}), "xformOp:rotateY", {});
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR((*found)[1], -160, 1e-9);
  EXPECT_FALSE(euler_degrees(rotation_by("X", {{5, 0, 0}}), "xformOp:rotateY", {}).has_value());
}

}  // namespace
}  // namespace tenon::bake
