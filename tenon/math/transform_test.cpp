// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/math/transform.h"

#include <cmath>

#include <gtest/gtest.h>

namespace tenon {
namespace {

constexpr double kPi = 3.14159265358979323846;

void expect_near(const Mat4d& a, const Mat4d& b, double tolerance) {
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      EXPECT_NEAR(a[i][j], b[i][j], tolerance) << i << "," << j;
    }
  }
}

void expect_near(const Vec3d& a, const Vec3d& b, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(a[i], b[i], tolerance) << i;
  }
}

Mat4d recomposed(const Factored& f) {
  const Mat3d r = f.scale_orientation;
  Mat3d s;
  for (std::size_t i = 0; i < 3; ++i) {
    s[i][i] = f.scale[i];
  }
  return to_mat4(r * s * transpose(r) * f.rotation, f.translation);
}

TEST(Matrix, AQuaternionRotatesRowVectorsAsItsMatrixDoes) {
  const Quatd q = rotation_about(normalized(Vec3d{{1, 2, 3}}), 0.7);
  const Vec3d p{{0.3, -2, 5}};
  expect_near(p * rotation_matrix(q), rotate(q, p), 1e-14);
  const Quatd back = rotation_of(rotation_matrix(q));
  EXPECT_NEAR(std::fabs(dot(back, q)), 1, 1e-14);
}

TEST(Matrix, TheInverseOfASingularMatrixIsRefused) {
  bool ok = true;
  inverse(Mat4d{}, &ok);
  EXPECT_FALSE(ok);
  const Mat4d m = scale_matrix({{2, 3, 4}}) * translation_matrix({{1, 2, 3}});
  expect_near(m * inverse(m, &ok), Mat4d::identity(), 1e-15);
  EXPECT_TRUE(ok);
}

TEST(Factor, ScaleRotationAndTranslationComeApart) {
  const Quatd q = rotation_about({{0, 0, 1}}, kPi / 6);
  const Mat4d m = scale_matrix({{2, 3, 4}}) * to_mat4(rotation_matrix(q), {{5, 6, 7}});
  const Factored f = factor(m);
  expect_near(f.scale, {{2, 3, 4}}, 1e-12);
  EXPECT_FALSE(f.sheared);
  EXPECT_NEAR(std::fabs(dot(rotation_of(f.rotation), q)), 1, 1e-12);
  expect_near(recomposed(f), m, 1e-12);
}

TEST(Factor, AMirrorMakesAllScalesNegative) {
  // S-34: scale (-2,3,4) comes back as (-2,-3,-4) with a half turn about X.
  const Factored f = factor(scale_matrix({{-2, 3, 4}}));
  expect_near(f.scale, {{-2, -3, -4}}, 1e-12);
  EXPECT_NEAR(std::fabs(dot(rotation_of(f.rotation), Quatd{1, 0, 0, 0})), 1, 1e-12);
}

TEST(Factor, AShearIsReportedAndStillRecomposes) {
  const Mat4d turned = to_mat4(rotation_matrix(rotation_about({{0, 0, 1}}, kPi / 6)));
  const Mat4d m = turned * scale_matrix({{1, 2, 1}});
  const Factored f = factor(m);
  EXPECT_TRUE(f.sheared);
  EXPECT_NEAR(determinant(f.rotation), 1, 1e-12);
  expect_near(recomposed(f), m, 1e-12);
}

TEST(Pose, ComposesAndInverts) {
  const Pose ab{{{1, 2, 3}}, rotation_about({{0, 1, 0}}, 0.4)};
  const Pose bc{{{-4, 0, 2}}, rotation_about({{1, 0, 0}}, -1.1)};
  const Vec3d p{{0.1, 0.2, 0.3}};
  expect_near(transform_point(ab * bc, p), transform_point(ab, transform_point(bc, p)), 1e-14);
  expect_near(transform_point(inverse(ab) * ab, p), p, 1e-14);
  expect_near(transform_point(p, pose_matrix(ab)), transform_point(ab, p), 1e-14);
}

TEST(Quaternion, SlerpTakesTheShorterWayAtConstantSpeed) {
  const Quatd a = kIdentityRotation;
  const Quatd b = rotation_about({{0, 0, 1}}, 2.0);
  const Quatd minus_b{-b.x, -b.y, -b.z, -b.w};
  EXPECT_NEAR(rotation_vector(slerp(a, b, 0.25))[2], 0.5, 1e-12);
  EXPECT_NEAR(rotation_vector(slerp(a, minus_b, 0.25))[2], 0.5, 1e-12);
}

}  // namespace
}  // namespace tenon
