// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tenon/engines/simulation.h"
#include "tenon/math/angle.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::bake {

/// When bodies rest: all of them that are not kinematic are slower than both bounds for a while.
struct RestRule {
  double linear_speed = 1e-3;       ///< [m/s]
  double angular_speed = kRadians;  ///< [rad/s]; one degree per second
  double duration = 0.2;            ///< [s]
};

/// Looks at a simulation after each of its steps.
class RestWatch {
 public:
  /// Its arguments must outlive it.
  RestWatch(const engines::Simulation& simulation, const scene::PhysicsScene& scene,
            const RestRule& rule)
      : simulation_(simulation), scene_(scene), rule_(rule) {}

  /// The time since when everything rests [s], once it has for the time of the rule.
  std::optional<double> look();

 private:
  bool is_slow() const;

  const engines::Simulation& simulation_;
  const scene::PhysicsScene& scene_;
  RestRule rule_;
  std::optional<double> since_;
};

}  // namespace tenon::bake
