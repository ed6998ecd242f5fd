// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/check/overlaps/convex_overlap.h"

#include <cmath>

#include <gtest/gtest.h>

namespace tenon::check {
namespace {

scene::Shape round_shape(scene::ShapeKind kind) {
  scene::Shape shape;
  shape.kind = kind;
  shape.radius = 0.2;
  shape.half_height = 0.25;
  shape.axis = scene::Axis::Y;
  return shape;
}

bool meets_floor(const scene::Shape& shape, double height) {
  scene::Shape floor;
  floor.kind = scene::ShapeKind::Box;
  floor.half_extents = {{10, 10, 0.5}};
  ConvexSolid a;
  a.shape = &shape;
  a.pose.position = {{-5, 0.3, height}};
  ConvexSolid b;
  b.shape = &floor;
  b.pose.position = {{0, 0, -0.5}};
  return overlap(a, b);
}

// What lies a tenth of its radius above a floor of fifty times its size does not reach into it.
TEST(ConvexOverlap, ARoundShapeJustAboveALargeFloorDoesNotReachIntoIt) {
  for (const scene::ShapeKind kind :
       {scene::ShapeKind::Cylinder, scene::ShapeKind::Capsule, scene::ShapeKind::Sphere}) {
    const scene::Shape shape = round_shape(kind);
    EXPECT_FALSE(meets_floor(shape, 0.22)) << static_cast<int>(kind);
    EXPECT_FALSE(meets_floor(shape, 0.205)) << static_cast<int>(kind);
    EXPECT_TRUE(meets_floor(shape, 0.15)) << static_cast<int>(kind);
  }
}

}  // namespace
}  // namespace tenon::check
