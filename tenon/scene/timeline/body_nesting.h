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
  /// `massless` is what bodies have whose mass is all in what the carrier's mass API says.
  BodyNesting(PhysicsScene& scene, const BodyMass& massless);

  bool empty() const { return bodies_.empty(); }
  /// Brings switches and masses of the scene to the state at a time [s]; after set_switch, which
  /// knows nothing of carriers. True when another state came into force.
  bool apply(PhysicsScene& scene, double time);
  /// Fixes what apply() found to be carried from now on where it is now. Gives those bodies.
  std::vector<CarriedBody> attach(PhysicsScene& scene);

 private:
  struct NestedBody {
    Index body = 0;
    Index joint = 0;
    bool carried = false;
    bool fresh = false;  ///< carried, and not attached yet
    Index carrier = 0;
  };
  void carry(PhysicsScene& scene, NestedBody& nested, const std::vector<CarriedBody>& carried);
  void set_mass(Body& body, const BodyMass& mass) const;

  BodyMass massless_;
  std::vector<NestedBody> bodies_;                      ///< ascending
  std::vector<std::pair<Index, BodyMass>> own_masses_;  ///< while all are on
  std::size_t state_ = static_cast<std::size_t>(-1);
};

}  // namespace tenon::scene
