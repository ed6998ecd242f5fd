// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "tenon/engines/simulation.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::watches {

/// A body that tumbles or precesses faster than the steps resolve.
struct FastSpin {
  scene::Index body = 0;
  double speed = 0;   ///< the largest that was seen [rad/s]
  double growth = 0;  ///< what steps of first order have added to its wobble, as a part of it
};

/// Looks at bodies that turn freely, alone or on joints with two rotations or more. With moments
/// that differ the direction of spin turns at a rate w; a step dt of first order makes the wobble
/// grow or shrink by (w dt)^2 / 2. A body that spins about a principal axis does not wobble.
class SpinWatch {
 public:
  /// Its arguments must outlive it.
  SpinWatch(const engines::Simulation& simulation, const scene::PhysicsScene& scene);

  void after_step();
  /// At the end of the run, by body.
  std::vector<FastSpin> fast() const;

 private:
  struct Watched {
    scene::Index body = 0;
    double speed = 0;
    double growth = 0;
  };
  void look(Watched& watched, double steps) const;

  const engines::Simulation& simulation_;
  const scene::PhysicsScene& scene_;
  std::vector<Watched> bodies_;
  std::size_t steps_ = 0;
};

}  // namespace tenon::watches
