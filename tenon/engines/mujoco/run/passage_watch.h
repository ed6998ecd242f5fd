// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "tenon/engines/mujoco/model.h"

namespace tenon::engines::mujoco {

/// Finds free bodies that are so fast that they pass through others between two steps.
class PassageWatch {
 public:
  struct Passage {
    scene::Index body = 0;
    scene::Index collider = 0;  ///< that it passed
    double step = 0;            ///< how far it moved [m]
  };

  PassageWatch() = default;
  PassageWatch(const scene::PhysicsScene& scene, const Model& model);

  bool empty() const { return bodies_.empty(); }
  /// After a step, before anything is derived from the new positions. Each pair is told once.
  std::vector<Passage> look(const Model& model);

 private:
  struct FreeBody {
    scene::Index body = 0;
    int id = 0;
    int qpos = 0;
    int dof = 0;
    int geom = 0;      ///< one that collides
    double speed = 0;  ///< squared; above it the body leaves its own place within a step
  };
  void look_along(const Model& model, const FreeBody& free, std::vector<Passage>& found);

  std::vector<FreeBody> bodies_;
  std::vector<std::pair<scene::Index, scene::Index>> told_;  ///< body and collider
};

}  // namespace tenon::engines::mujoco
