// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "tenon/scene/physics_scene.h"

namespace tenon::scene {

/// Keeps the bodies of a scene that are off inside others on those (S-23): by a fixed joint that is
/// enabled for as long, and by the masses of that state.
class BodyNesting {
 public:
  /// Nothing is ever nested.
  BodyNesting() = default;
  /// Adds the joints to the end of the scene's, disabled, and applies the state at the start.
  /// `massless` is what bodies have whose mass is all in what the outer body's mass API says.
  BodyNesting(PhysicsScene& scene, const BodyMass& massless);

  bool empty() const { return bodies_.empty(); }
  /// Brings switches and masses of the scene to the state at a time [s]; after set_switch, which
  /// knows nothing of merged bodies. True when another state came into force.
  bool apply(PhysicsScene& scene, double time);
  /// Fixes what apply() found to be merged from now on where it is now. Gives those bodies.
  std::vector<MergedBody> attach(PhysicsScene& scene);

 private:
  struct NestedBody {
    Index body = 0;
    Index joint = 0;
    bool merged = false;
    bool fresh = false;  ///< merged, and not attached yet
    Index into = 0;
  };
  void merge(PhysicsScene& scene, NestedBody& nested, const std::vector<MergedBody>& merged);
  void set_mass(Body& body, const BodyMass& mass) const;

  BodyMass massless_;
  std::vector<NestedBody> bodies_;                      ///< ascending
  std::vector<std::pair<Index, BodyMass>> own_masses_;  ///< while all are on
  std::size_t state_ = static_cast<std::size_t>(-1);
};

}  // namespace tenon::scene
