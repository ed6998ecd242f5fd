// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "tenon/engines/mujoco/model.h"
#include "tenon/physics/physics_scene.h"

namespace tenon::engines::mujoco {

/// Keeps the bodies of a scene that are off inside others on those (S-23): by a fixed joint that is
/// enabled for as long, and by the masses of that state.
class BodyNesting {
 public:
  /// Nothing is ever nested.
  BodyNesting() = default;
  /// Adds the joints to the end of the scene's, disabled, and applies the state at the start.
  explicit BodyNesting(physics::PhysicsScene& scene);

  bool empty() const { return bodies_.empty(); }
  /// Brings switches and masses of the scene to the state at a time [s]; after set_switch, which
  /// knows nothing of carriers. True when another state came into force.
  bool apply(physics::PhysicsScene& scene, double time);
  /// Fixes what apply() found to be carried from now on where it is now. Gives those bodies.
  std::vector<physics::CarriedBody> attach(physics::PhysicsScene& scene);

 private:
  struct NestedBody {
    physics::Index body = 0;
    physics::Index joint = 0;
    bool carried = false;
    bool fresh = false;  ///< carried, and not attached yet
    physics::Index carrier = 0;
  };
  void carry(physics::PhysicsScene& scene, NestedBody& nested,
             const std::vector<physics::CarriedBody>& carried);

  std::vector<NestedBody> bodies_;                                        ///< ascending
  std::vector<std::pair<physics::Index, physics::BodyMass>> own_masses_;  ///< while all are on
  std::size_t state_ = static_cast<std::size_t>(-1);
};

/// Lets a body that became a part of another bring its momentum along, as in a plastic impact:
/// changes the generalized velocities of a model whose positions are set. `velocity` [m/s] of the
/// carried body's centre of mass before, and `spin` [rad/s], in world axes.
void join_momentum(const physics::Body& body, const BodyMap& map, const Vec3d& velocity,
                   const Vec3d& spin, const mjModel& model, mjData& data);

}  // namespace tenon::engines::mujoco
