// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/fields/near_fields.h"

#include <gtest/gtest.h>

#include "tenon/scene/physics_scene.h"

namespace tenon::scene {
namespace {

TEST(NearFields, RoundingIsNear) {
  Drive a;
  a.stiffness = 3;
  Drive b = a;
  EXPECT_TRUE(near_fields(a, b));
  b.stiffness = 3 * (1 + 1e-12);
  EXPECT_TRUE(near_fields(a, b));
  b.stiffness = 3.001;
  EXPECT_FALSE(near_fields(a, b));
}

TEST(NearFields, NothingIsNearInfinity) {
  Drive bounded;
  bounded.max_force = 2;
  EXPECT_FALSE(near_fields(bounded, Drive{}));
  EXPECT_TRUE(near_fields(Drive{}, Drive{}));
  Joint open;
  Joint closed;
  closed.upper = 1;
  EXPECT_FALSE(near_fields(open, closed));
  EXPECT_FALSE(near_numbers(Vec3d{{kUnlimited, 0, 0}}.v, Vec3d{{1, 0, 0}}.v));
}

}  // namespace
}  // namespace tenon::scene
