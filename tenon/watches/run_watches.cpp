// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/watches/run_watches.h"

namespace tenon::watches {

RunWatches::RunWatches(const engines::Simulation& simulation, const scene::PhysicsScene& scene,
                       Steering steering)
    : steering_(steering),
      joints_(simulation, scene, steering == Steering::Commands),
      spins_(simulation, scene),
      energy_(simulation, scene) {}

void RunWatches::after_step() {
  joints_.after_step();
  spins_.after_step();
  if (steering_ == Steering::None) {
    energy_.after_step();
  }
}

RunFaults RunWatches::faults() const {
  RunFaults found;
  found.joints = joints_.faults();
  found.spins = spins_.fast();
  if (steering_ == Steering::None) {
    found.drift = energy_.drift();
  }
  return found;
}

}  // namespace tenon::watches
