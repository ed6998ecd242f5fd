// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "tenon/engines/mujoco/model.h"
#include "tenon/engines/simulation_values.h"

namespace tenon::engines::mujoco {

/// What enters and leaves trigger colliders. Triggers do not tell of each other, nor of what
/// cannot move against them.
class Triggers {
 public:
  Triggers() = default;
  explicit Triggers(const scene::PhysicsScene& scene);

  bool empty() const { return pairs_.empty(); }
  /// Looks again, with the poses that the data have; events go to `events` where it is not null.
  void update(const scene::PhysicsScene& scene, const Model& model, std::vector<Event>* events);

 private:
  struct Pair {
    scene::Index trigger = 0;
    scene::Index other = 0;
    bool inside = false;
  };
  std::vector<Pair> pairs_;
};

}  // namespace tenon::engines::mujoco
