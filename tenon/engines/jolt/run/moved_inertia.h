// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "tenon/engines/jolt/model.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::engines::jolt {

/// What a force along a coordinate has to move: all that hangs on both sides of it, by which drives
/// of accelerations and mimics with a frequency are scaled. Jolt itself sees two bodies that
/// nothing else holds, whose inertia is many times smaller.
class MovedInertia {
 public:
  MovedInertia() = default;
  MovedInertia(const scene::PhysicsScene& scene, const Model& model);
  /// Before each step: gives each law that asks for it the inertia along its sum.
  void find(const Model& model) const;

 private:
  struct Asking {
    CoordinateLaw* law = nullptr;
    std::vector<scene::Index> joints;  ///< of its parts
  };

  const scene::PhysicsScene* scene_ = nullptr;
  std::vector<Asking> asking_;
  std::vector<scene::Index> bodies_;  ///< of their trees, parents before children
  std::vector<std::size_t> member_;   ///< (body_count) into bodies_
};

}  // namespace tenon::engines::jolt
