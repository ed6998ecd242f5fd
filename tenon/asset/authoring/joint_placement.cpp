// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The anchor of a side goes through the whole matrix of its prim, scale included; the rotation of
// the frame is relative to the rigid rotation of the prim (S-83, S-84).
#include "tenon/asset/authoring/joint_placement.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tenon/base/text/text_number.h"
#include "tenon/math/matrix.h"
#include "tenon/stage/transform_at.h"

namespace tenon {
namespace {

struct Side {
  Mat4d world = Mat4d::identity();
  Quatd rotation = kIdentityRotation;
};

Side side_of(const stage::Prim& prim, double start) {
  if (!prim) {
    return {};
  }
  const Mat4d world = stage::local_to_world(prim, stage::Time(start));
  return {world, rigid_part(world).orientation};
}

/// Rounding noise of numbers that cancel becomes 0.
double without_noise(double value, double size) {
  return std::abs(value) < 1e-9 * size ? 0 : value;
}

Vec3d in_space(const Side& side, const Vec3d& point) {
  const Vec3d local = transform_point(point, inverse(side.world));
  const double size = 1 + std::max({std::abs(point[0]), std::abs(point[1]), std::abs(point[2])});
  return {{without_noise(local[0], size), without_noise(local[1], size),
           without_noise(local[2], size)}};
}

Quatd in_rotation(const Side& side, const Quatd& world) {
  Quatd local = normalized(conjugate(side.rotation) * world);
  const double sign = local.w < 0 ? -1 : 1;
  return {without_noise(sign * local.x, 1), without_noise(sign * local.y, 1),
          without_noise(sign * local.z, 1), without_noise(sign * local.w, 1)};
}

/// The shortest turn that takes X to a direction.
Quatd turn_from_x(const Vec3d& direction) {
  const Vec3d to = normalized(direction);
  if (to[0] < -1 + 1e-12) {
    return {0, 0, 1, 0};
  }
  const Vec3d axis = cross(Vec3d{{1, 0, 0}}, to);
  return normalized(Quatd{axis[0], axis[1], axis[2], 1 + to[0]});
}

}  // namespace

Result<Vec3d> read_vector(const std::string& text, const std::string& what) {
  std::string plain = text;
  std::erase_if(plain, [](char c) { return c == '(' || c == ')' || c == ' '; });
  std::array<double, 3> numbers{};
  std::size_t begin = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t end = i < 2 ? plain.find(',', begin) : plain.size();
    const auto number = end == std::string::npos || begin > end
                            ? std::nullopt
                            : parse_double(std::string_view(plain).substr(begin, end - begin));
    if (!number || !std::isfinite(*number)) {
      return Error(ErrorCode::Invalid, "--" + what + " " + text + " is not three numbers")
          .with_rule("edit.bad-argument")
          .with_fix("write --" + what + " X,Y,Z");
    }
    numbers[i] = *number;
    begin = end + 1;
  }
  return Vec3d{{numbers[0], numbers[1], numbers[2]}};
}

Result<JointPlacement> place_joint(const JointWish& wish, double start) {
  const Side side0 = side_of(wish.body0, start);
  const Side side1 = side_of(wish.body1, start);
  const Side& child = wish.body1 ? side1 : side0;
  const auto origin = [](const Side& side) { return transform_point(Vec3d{}, side.world); };
  const bool apart = wish.own_origins && !wish.at && wish.body0 && wish.body1;
  const Vec3d anchor1 = wish.at.value_or(origin(child));
  const Vec3d anchor0 = apart ? origin(side0) : anchor1;
  JointPlacement placed;
  Quatd world = child.rotation;
  placed.axis = "X";
  if (wish.axis == "X" || wish.axis == "Y" || wish.axis == "Z") {
    placed.axis = wish.axis;
    world = kIdentityRotation;
  } else if (!wish.axis.empty()) {
    TENON_TRY(const Vec3d direction, read_vector(wish.axis, "axis"));
    if (dot(direction, direction) == 0) {
      return Error(ErrorCode::Invalid, "--axis " + wish.axis + " is not a direction")
          .with_rule("edit.bad-argument")
          .with_fix("write X, Y, Z, or a direction other than 0,0,0");
    }
    world = turn_from_x(direction);
  }
  placed.position0 = in_space(side0, anchor0);
  placed.position1 = in_space(side1, anchor1);
  placed.rotation0 = in_rotation(side0, world);
  placed.rotation1 = in_rotation(side1, world);
  return placed;
}

}  // namespace tenon
