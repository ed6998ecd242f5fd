// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/jolt/model.h"

#include <utility>

#include "tenon/engines/jolt/convert.h"

namespace tenon::engines::jolt {

Model& Model::operator=(Model&& other) noexcept {
  release();
  systems = std::move(other.systems);
  bodies = std::exchange(other.bodies, {});
  static_bodies = std::exchange(other.static_bodies, {});
  joints = std::exchange(other.joints, {});
  laws = std::exchange(other.laws, {});
  trees = std::exchange(other.trees, {});
  forest = std::move(other.forest);
  not_mapped = std::move(other.not_mapped);
  time_step = other.time_step;
  return *this;
}

// Constraints before the bodies that they point to, bodies with their system.
void Model::release() {
  joints.clear();
  laws.clear();
  trees.clear();
  bodies.clear();
  static_bodies.clear();
  systems.clear();
}

Pose pose_of(const JPH::Body& body) {
  return {from_jolt(body.GetPosition()), from_jolt(body.GetRotation())};
}

}  // namespace tenon::engines::jolt
