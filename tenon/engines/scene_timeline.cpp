// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/scene_timeline.h"

#include <cstddef>

namespace tenon::engines {

std::unique_ptr<scene::Timeline> timeline_of(const scene::PhysicsScene& scene) {
  scene::BodyMass least;
  least.mass = kMinMass;
  least.inertia = {};
  for (std::size_t i = 0; i < 3; ++i) {
    least.inertia[i][i] = kMinMoment;
  }
  return std::make_unique<scene::Timeline>(scene, least);
}

std::unique_ptr<scene::Timeline> timeline_where_needed(const scene::PhysicsScene& scene) {
  return scene::Timeline::is_needed(scene) ? timeline_of(scene) : nullptr;
}

}  // namespace tenon::engines
