// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tenon/engines/simulation.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::bake {

/// What a joint does that none should. Of joints with one degree of freedom.
struct JointFault {
  enum class Kind : std::uint8_t {
    Shakes,       ///< its velocity changes sign within a few steps, for at least half of the run
    BeyondLimit,  ///< it ends the run outside of hard limits
  };
  scene::Index joint = 0;
  Kind kind = Kind::Shakes;
  bool angular = true;
  double amount = 0;  ///< of Shakes the largest speed [rad/s or m/s], else how far [rad or m]
};

/// Looks at joints after each step of a run, at eight steps of 64.
class JointWatch {
 public:
  /// Its arguments must outlive it.
  JointWatch(const engines::Simulation& simulation, const scene::PhysicsScene& scene);

  void after_step();
  /// At the end of the run, by joint.
  std::vector<JointFault> faults() const;

 private:
  struct Watched {
    scene::Index joint = 0;
    bool angular = true;
    double lower = 0;  ///< [m or rad]; infinite where nothing or a spring bounds it
    double upper = 0;
    double last = 0;  ///< velocity at the step before
    // In this window:
    int changes = 0;  ///< of its sign
    double sum = 0;   ///< of speeds
    double top = 0;   ///< the largest
    // So far:
    std::size_t shaken = 0;  ///< windows in which it shook
    double fastest = 0;      ///< in those
  };
  void look(Watched& watched, std::size_t step_of_window) const;

  const engines::Simulation& simulation_;
  std::vector<Watched> joints_;
  std::size_t steps_ = 0;
  std::size_t windows_ = 0;
};

}  // namespace tenon::bake
