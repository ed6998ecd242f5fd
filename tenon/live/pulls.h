// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/engines/world.h"
#include "tenon/math/vector.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::live {

/// A pull on a point of a body: a given force, or a spring to a point that somebody drags.
struct Pull {
  scene::Index body = 0;
  Vec3d anchor;  ///< in the body frame [m]
  bool to_target = false;
  Vec3d force;   ///< world axes [N]; of springs computed at every step
  Vec3d target;  ///< of springs, world [m]
};

/// Who pulls at what: one pull for each client. The force of a spring follows from the mass of the
/// tree of bodies that hangs on joints with the body, so that a gram and a ton can both be dragged,
/// and is bounded by what one time step of the body itself takes without becoming unstable.
class Pulls {
 public:
  /// Of a new scene; all pulls are gone.
  void begin(const scene::PhysicsScene& scene);
  void set(std::uint64_t client, const Pull& pull) { pulls_[client] = pull; }
  void release(std::uint64_t client) { pulls_.erase(client); }
  std::size_t count() const { return pulls_.size(); }

  /// Sets the sum of the pulls on each body for the next step; bodies that were let go get none.
  /// Errors: those of World::set_body_wrench.
  Result<void> apply(engines::World& world, const scene::PhysicsScene& scene);

 private:
  Vec3d force_of(const Pull& pull, const engines::World& world, const scene::Body& body) const;

  std::map<std::uint64_t, Pull> pulls_;
  std::set<scene::Index> pulled_;    // have a wrench in the engine
  std::vector<double> tree_masses_;  // [kg] (body_count)
};

}  // namespace tenon::live
