// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/engines/jolt/build/build.h"

namespace tenon::engines::jolt {

/// A shape of Jolt, and where it is in what it belongs to.
struct PlacedShape {
  JPH::RefConst<JPH::Shape> shape;
  Pose pose;
};

/// What a collider is made of in Jolt; nothing, and said, where Jolt refuses the shape. `moves`: of
/// a body that forces move.
std::vector<PlacedShape> shapes_of(Build& build, scene::Index collider, bool moves);
/// All of them as one shape with its centre of mass at `center`.
JPH::RefConst<JPH::Shape> joined_shape(const std::vector<PlacedShape>& parts, const Vec3d& center);

}  // namespace tenon::engines::jolt
