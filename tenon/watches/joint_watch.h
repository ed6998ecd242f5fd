// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tenon/engines/simulation.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::watches {

/// What a joint does that none should. Of joints with one degree of freedom.
struct JointFault {
  enum class Kind : std::uint8_t {
    Shakes,       ///< its velocity changes sign within a few steps, for at least half of the run
    BeyondLimit,  ///< it ends the run outside of hard limits
    Sags,         ///< its drive rests away from its target, under the weight that it carries
  };
  scene::Index joint = 0;
  Kind kind = Kind::Shakes;
  bool angular = true;
  double amount = 0;  ///< of Shakes the largest speed [rad/s or m/s], else how far [rad or m]
  double load = 0;    ///< of Sags: what weight exerts along the joint [N m or N], not negative
};

/// One degree or one millimetre [rad or m]: what coordinates are told in.
double joint_unit(bool angular);

/// Looks at joints after each step of a run, at eight steps of 64; where there are more than eight,
/// at every other one.
class JointWatch {
 public:
  /// Its arguments must outlive it. `steered`: targets are set during the run, so that no drive is
  /// asked whether it holds.
  JointWatch(const engines::Simulation& simulation, const scene::PhysicsScene& scene, bool steered);

  void after_step();
  /// At the end of the run, by joint.
  std::vector<JointFault> faults() const;

 private:
  struct Watched {
    scene::Index joint = 0;
    bool angular = true;
    double lower = 0;  ///< [m or rad]; infinite where nothing or a spring bounds it
    double upper = 0;
    bool holds = false;  ///< by its only drive, to a fixed position
    double last = 0;     ///< velocity at the step before
    // In this window:
    int changes = 0;  ///< of its sign
    double sum = 0;   ///< of speeds
    double top = 0;   ///< the largest
    // So far:
    std::size_t windows = 0;    ///< at whose end it was looked at
    std::size_t shaken = 0;     ///< windows in which it shook
    double fastest = 0;         ///< in those
    double target = 0;          ///< of that drive, within the limits
    double place = 0;           ///< position from which it has not moved much
    std::size_t still = 0;      ///< windows since it is there
    std::size_t saturated = 0;  ///< windows at whose end the spring asked for more than maxForce
  };
  void look(Watched& watched, std::size_t step_of_window) const;
  void find_sagging(std::vector<JointFault>& found) const;

  const engines::Simulation& simulation_;
  const scene::PhysicsScene& scene_;
  std::vector<Watched> joints_;
  std::size_t steps_ = 0;
  std::size_t windows_ = 0;  ///< so far, of all joints
};

}  // namespace tenon::watches
