// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/shapes/ellipsoid.h"

#include <cmath>
#include <numbers>

namespace tenon::convert {
namespace {

using layer::Value;

// 62 points: no engine's hull is bounded below that.
constexpr int kRings = 6;
constexpr int kSides = 10;

/// The points of a ball, from its lowest up, and triangles that are seen from outside.
struct Ball {
  std::vector<Vec3d> points;
  std::vector<std::int32_t> corners;
};

Ball make_ball() {
  constexpr double kHalfTurn = std::numbers::pi;
  Ball ball;
  ball.points.push_back({{0, 0, -1}});
  for (int ring = 1; ring <= kRings; ++ring) {
    const double height = kHalfTurn * ring / (kRings + 1);
    for (int side = 0; side < kSides; ++side) {
      const double turn = 2 * kHalfTurn * side / kSides;
      ball.points.push_back({{std::sin(height) * std::cos(turn), std::sin(height) * std::sin(turn),
                              -std::cos(height)}});
    }
  }
  ball.points.push_back({{0, 0, 1}});
  const int top = static_cast<int>(ball.points.size()) - 1;
  const auto at = [](int ring, int side) { return 1 + ring * kSides + side % kSides; };
  for (int side = 0; side < kSides; ++side) {
    ball.corners.insert(ball.corners.end(), {0, at(0, side + 1), at(0, side)});
    for (int ring = 0; ring + 1 < kRings; ++ring) {
      const int a = at(ring, side);
      const int b = at(ring, side + 1);
      const int c = at(ring + 1, side + 1);
      const int d = at(ring + 1, side);
      ball.corners.insert(ball.corners.end(), {a, b, c, a, c, d});
    }
    ball.corners.insert(ball.corners.end(), {at(kRings - 1, side), at(kRings - 1, side + 1), top});
  }
  return ball;
}

double volume(const Ball& ball) {
  double sum = 0;
  for (std::size_t i = 0; i + 2 < ball.corners.size(); i += 3) {
    const auto point = [&](std::size_t k) -> const Vec3d& {
      return ball.points[static_cast<std::size_t>(ball.corners[i + k])];
    };
    sum += dot(point(0), cross(point(1), point(2))) / 6;
  }
  return sum;
}

}  // namespace

Path write_ellipsoid(RobotLayer& layer, Path link, Token name, const Vec3d& half_extents,
                     const Pose& pose) {
  const Ball ball = make_ball();
  // As much room as the ellipsoid has, so that a mass of a density is nearly right.
  const double wider = std::cbrt(4.0 / 3 * std::numbers::pi / volume(ball));
  std::vector<Vec3f> points;
  std::vector<Vec3f> normals;  // the ellipsoid's own, so that it is drawn round
  Vec3d most;
  for (const Vec3d& unit : ball.points) {
    Vec3d point;
    Vec3d normal;
    for (std::size_t k = 0; k < 3; ++k) {
      point[k] = unit[k] * half_extents[k] * wider;
      most[k] = std::fmax(most[k], point[k]);
      normal[k] = unit[k] / half_extents[k];
    }
    points.push_back(to_float(point + Vec3d{}));
    normals.push_back(to_float(normalized(normal) + Vec3d{}));
  }
  LayerBuilder& builder = layer.builder();
  const Path prim = builder.define(link, name, "Mesh");
  builder.set_value(prim, "Mesh", "extent",
                    Value(std::vector<Vec3f>{to_float(-most), to_float(most)}));
  builder.set_value(prim, "Mesh", "faceVertexCounts",
                    Value(std::vector<std::int32_t>(ball.corners.size() / 3, 3)));
  builder.set_value(prim, "Mesh", "faceVertexIndices", Value(ball.corners));
  builder.set_value(prim, "Mesh", "normals", Value(std::move(normals)));
  builder.set_metadata(prim.property("normals"), "interpolation", Value(Token("vertex")));
  builder.set_value(prim, "Mesh", "points", Value(std::move(points)));
  builder.set_value(prim, "Mesh", "subdivisionScheme", Value(Token("none")));
  builder.set_custom(prim, "tenon:ellipsoid", "double3", Value(half_extents));
  layer.set_pose(prim, pose);
  return prim;
}

}  // namespace tenon::convert
