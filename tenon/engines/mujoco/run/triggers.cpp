// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/run/triggers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tenon::engines::mujoco {
namespace {

bool geoms_overlap(const mjModel& m, mjData& d, int a, int b) {
  const double reach = m.geom_rbound[a] + m.geom_rbound[b];
  if (m.geom_rbound[a] > 0 && m.geom_rbound[b] > 0) {  // 0: a plane
    const double* x = d.geom_xpos + std::ptrdiff_t{3} * a;
    const double* y = d.geom_xpos + std::ptrdiff_t{3} * b;
    if (std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]) > reach) {
      return false;
    }
  }
  constexpr double kLook = 1e-6;  // [m] so that a touch is told from none
  return mj_geomDistance(&m, &d, a, b, kLook, nullptr) <= 0;
}

bool overlap(const Model& model, scene::Index first, scene::Index second) {
  for (const int a : model.geoms_of_collider[first]) {
    for (const int b : model.geoms_of_collider[second]) {
      if (geoms_overlap(*model.model, *model.data, a, b)) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

Triggers::Triggers(const scene::PhysicsScene& scene) {
  for (scene::Index i = 0; i < scene.colliders.size(); ++i) {
    if (!scene.colliders[i].settings.trigger) {
      continue;
    }
    for (scene::Index j = 0; j < scene.colliders.size(); ++j) {
      const scene::Collider& other = scene.colliders[j];
      if (!other.settings.trigger &&
          (scene.is_dynamic(scene.colliders[i].body) || other.body.has_value()) &&
          scene.may_meet(i, j)) {
        pairs_.push_back({i, j});
      }
    }
  }
}

void Triggers::update(const scene::PhysicsScene& scene, const Model& model,
                      std::vector<Event>* events) {
  for (Pair& pair : pairs_) {
    const bool inside = overlap(model, pair.trigger, pair.other);
    if (inside != pair.inside && events != nullptr) {
      events->push_back(
          {model.data->time, scene.colliders[pair.trigger].path,
           (inside ? "entered by <" : "left by <") + scene.colliders[pair.other].path.str() + ">"});
    }
    pair.inside = inside;
  }
}

}  // namespace tenon::engines::mujoco
