// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/engines/engines.h"
#include "tenon/engines/world.h"

namespace tenon::engines {

struct EnvironmentOptions {
  std::size_t count = 1;
  std::size_t threads = 0;  ///< 0: as many as this process may use
  SimulationOptions simulation{};
};

/// Many independent simulations of one scene. Each can be given values of its own (mass, friction,
/// gains, gravity, states) as a World; those that share a value share its memory where the engine
/// can. The results do not depend on the number of threads.
class Environments {
 public:
  /// `scene` must outlive them. Errors: Limit for more than limits::kEnvironments; those of making
  /// a simulation.
  static Result<Environments> make(const Engine& engine, const scene::PhysicsScene& scene,
                                   const EnvironmentOptions& options, Diagnostics& diagnostics);

  /// Of worlds that were made one by one, of scenes with the same bodies, joints and drives as
  /// `scene`. Errors: Limit as above, or for none. `threads` as in EnvironmentOptions.
  static Result<Environments> of_worlds(std::vector<World> worlds, const scene::PhysicsScene& scene,
                                        std::size_t threads);

  /// The environments of all parts in their order, as of_worlds() makes them.
  static Result<Environments> joined(std::vector<Environments> parts,
                                     const scene::PhysicsScene& scene, std::size_t threads);

  std::size_t size() const { return worlds_.size(); }
  /// Not while step() runs.
  World& operator[](std::size_t i) { return worlds_[i]; }
  const World& operator[](std::size_t i) const { return worlds_[i]; }

  /// Steps all of them, side by side. Those that fail stop for good; returns how many.
  std::size_t step(std::size_t count = 1);
  /// Why an environment stopped; nullptr while it runs.
  const Error* failure(std::size_t i) const;
  /// Resets one to the start; it runs again.
  Result<void> reset(std::size_t i);

  /// Coordinates of all joints, joint by joint, and how many an environment has.
  std::size_t coordinate_count() const { return coordinate_count_; }
  /// Positions and velocities [m, rad, m/s, rad/s], (size x coordinate_count) each, row by row.
  /// Errors: Invalid where the spans have other sizes.
  Result<void> read_joints(std::span<double> positions, std::span<double> velocities) const;
  /// Drives of all joints, joint by joint, and how many an environment has.
  std::size_t drive_count() const { return drives_.size(); }
  /// Position targets [m or rad], (size x drive_count), row by row; velocity targets become 0.
  /// Drives that exert no force are skipped. Errors: Invalid for another size or such numbers.
  Result<void> set_drive_positions(std::span<const double> targets);

 private:
  struct DriveAt {
    scene::Index joint = 0;
    scene::Index drive = 0;
  };
  Environments() = default;

  std::vector<World> worlds_;
  std::vector<std::optional<Error>> failures_;
  std::size_t threads_ = 1;
  std::size_t joint_count_ = 0;
  std::size_t coordinate_count_ = 0;
  std::vector<DriveAt> drives_;
};

}  // namespace tenon::engines
