// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/engines/mujoco/model.h"

namespace tenon::engines::mujoco {

/// Limits and tendons of a model whose bounds follow tracks (S-28).
class MovingBounds {
 public:
  MovingBounds() = default;
  MovingBounds(const scene::PhysicsScene& scene, const Model& model);

  /// Gives the model the bounds of the joints as the scene has them now. False where it lacks a
  /// coordinate or a tendon for that: it must be rebuilt.
  bool write(const scene::PhysicsScene& scene, Model& model) const;

 private:
  struct Bounded {
    scene::Index joint = 0;
    int tendon_max = -1;
    int tendon_min = -1;
    int tendon_cone = -1;
    double cone_reach = 0;  ///< tendon length of a cone = reach sin(angle / 2)
  };
  static bool write(const scene::Joint& joint, const Bounded& bounded, Model& model);

  std::vector<Bounded> bounded_;
};

}  // namespace tenon::engines::mujoco
