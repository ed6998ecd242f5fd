// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>

#include "tenon/engines/jolt/jolt_headers.h"
#include "tenon/math/transform.h"

/// Numbers of the scene as Jolt has them, and back: positions in double precision, all else in
/// single precision.
namespace tenon::engines::jolt {

/// Single precision ends at 3.4e38, which Jolt takes for "without bound".
inline float to_jolt(double number) {
  constexpr double kMost = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(number, -kMost, kMost));
}
inline JPH::Vec3 to_jolt(const Vec3d& v) { return {to_jolt(v[0]), to_jolt(v[1]), to_jolt(v[2])}; }
inline JPH::RVec3 to_jolt_place(const Vec3d& v) { return {v[0], v[1], v[2]}; }
inline JPH::Quat to_jolt(const Quatd& q) {
  const Quatd unit = normalized(q);
  return JPH::Quat(to_jolt(unit.x), to_jolt(unit.y), to_jolt(unit.z), to_jolt(unit.w)).Normalized();
}

inline Vec3d from_jolt(JPH::Vec3Arg v) { return {{v.GetX(), v.GetY(), v.GetZ()}}; }
inline Vec3d from_jolt(JPH::DVec3Arg v) { return {{v.GetX(), v.GetY(), v.GetZ()}}; }
inline Quatd from_jolt(JPH::QuatArg q) {
  return normalized(Quatd{q.GetX(), q.GetY(), q.GetZ(), q.GetW()});
}

}  // namespace tenon::engines::jolt
