// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/engines/physx/physx_library.h"
#include "tenon/math/transform.h"
#include "tenon/scene/physics_scene.h"

/// Numbers of the scene as PhysX has them, in single precision, and back.
namespace tenon::engines::physx {

inline px::PxVec3 to_px(const Vec3d& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}
inline px::PxQuat to_px(const Quatd& q) {
  const Quatd unit = normalized(q);
  return {static_cast<float>(unit.x), static_cast<float>(unit.y), static_cast<float>(unit.z),
          static_cast<float>(unit.w)};
}
inline px::PxTransform to_px(const Pose& pose) {
  px::PxTransform made(to_px(pose.position), to_px(pose.orientation));
  made.q.normalize();
  return made;
}
/// Single precision ends at 3.4e38, which PhysX takes for "without bound".
inline float to_px(double number) {
  return number >= static_cast<double>(PX_MAX_F32) ? PX_MAX_F32 : static_cast<float>(number);
}

inline Vec3d from_px(const px::PxVec3& v) { return {{v.x, v.y, v.z}}; }
inline Quatd from_px(const px::PxQuat& q) { return normalized(Quatd{q.x, q.y, q.z, q.w}); }
inline Pose from_px(const px::PxTransform& pose) { return {from_px(pose.p), from_px(pose.q)}; }

/// The shortest rotation that brings x to a unit axis.
inline Quatd rotation_from_x(const Vec3d& axis) {
  const Vec3d x{{1, 0, 0}};
  if (dot(x, axis) < -1 + 1e-12) {
    return {0, 0, 1, 0};
  }
  const Vec3d turn = cross(x, axis);
  return normalized(Quatd{turn[0], turn[1], turn[2], 1 + dot(x, axis)});
}

}  // namespace tenon::engines::physx
