// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/scene/body_state.h"
#include "tenon/scene/physics_scene.h"

/// What every engine offers: a model made from a PhysicsScene that can be stepped and read.
namespace tenon::engines {

struct SimulationOptions {
  double time_step = 0;  ///< [s]; 0: what the asset asks for, else the engine's default
};

using BodyState = scene::BodyState;

/// Coordinates of the free degrees of freedom of one joint, in Dof order [m, rad].
struct JointState {
  std::vector<double> position;
  std::vector<double> velocity;
};

/// Something that the engine cannot express; the simulation went on without it.
struct NotMapped {
  Path prim;
  std::string property;
  std::string why;
};

/// Something that changed for good while the simulation ran.
struct Event {
  double time = 0;  ///< [s]
  Path prim;
  std::string what;  ///< "broke under 120 N and 3 N m"
};

struct Energy {
  double kinetic = 0;    ///< [J]
  double potential = 0;  ///< gravity and springs [J]
  double total() const { return kinetic + potential; }
};

class Simulation {
 public:
  virtual ~Simulation() = default;

  /// One time step; an Error with code Unstable when the state leaves the finite numbers or the
  /// engine resets itself.
  virtual Result<void> step() = 0;
  virtual double time() const = 0;       ///< [s] since the start
  virtual double time_step() const = 0;  ///< [s]

  virtual BodyState body_state(scene::Index body) const = 0;
  virtual JointState joint_state(scene::Index joint) const = 0;
  virtual Energy energy() const = 0;
  virtual std::size_t contact_count() const = 0;
  /// Degrees of freedom that the engine simulates.
  virtual std::size_t dof_count() const = 0;
  virtual const std::vector<NotMapped>& not_mapped() const = 0;
  /// Joints that broke so far, in time order (S-93).
  virtual const std::vector<Event>& events() const = 0;
};

}  // namespace tenon::engines
