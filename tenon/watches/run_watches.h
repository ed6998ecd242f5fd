// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tenon/engines/simulation.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/watches/energy_drift.h"
#include "tenon/watches/joint_watch.h"
#include "tenon/watches/spin_watch.h"

/// What is wrong with a run that goes to its end, found from the states that every engine has.
namespace tenon::watches {

struct RunFaults {
  std::vector<JointFault> joints{};
  std::vector<FastSpin> spins{};
  std::optional<EnergyDrift> drift;
};

/// Who acts on a simulation while it is watched.
enum class Steering : std::uint8_t {
  None,      ///< the asset alone
  Commands,  ///< somebody else too: energy is not compared, and no drive is asked whether it holds
};

/// All watches of one run.
class RunWatches {
 public:
  /// Its arguments must outlive it.
  RunWatches(const engines::Simulation& simulation, const scene::PhysicsScene& scene,
             Steering steering);

  void after_step();
  /// Of the steps until now.
  RunFaults faults() const;
  Steering steering() const { return steering_; }

 private:
  Steering steering_;
  JointWatch joints_;
  SpinWatch spins_;
  EnergyDriftWatch energy_;
};

}  // namespace tenon::watches
