// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tenon/engines/simulation.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::watches {

/// Energy that a run lost or gained where nothing takes or gives any.
struct EnergyDrift {
  double change = 0;  ///< of kinetic and potential energy together [J]
  /// What it is compared with: the largest kinetic energy, or the work of the weight over the size
  /// of the bodies where that is more [J].
  double moved = 0;
};

/// Looks at the energy of a scene in which bodies only fly and swing: no drive, damping,
/// friction, limit or force, nothing that follows poses, and no colliders that may touch.
class EnergyDriftWatch {
 public:
  /// Its arguments must outlive it.
  EnergyDriftWatch(const engines::Simulation& simulation, const scene::PhysicsScene& scene);

  void after_step();
  /// At the end of the run, where it is more than 2 %.
  std::optional<EnergyDrift> drift() const;

 private:
  bool is_capped() const;

  const engines::Simulation& simulation_;
  const scene::PhysicsScene& scene_;
  bool closed_;
  double start_ = 0;  ///< [J]
  double moved_ = 0;
  std::size_t steps_ = 0;
};

}  // namespace tenon::watches
