// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each environment is a World of its own; threads take every n-th of them, so that none waits for
// another and no result depends on how many threads there are.
#include "tenon/engines/environments.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "tenon/base/limits/engine_limits.h"
#include "tenon/base/parallel.h"
#include "tenon/engines/sensors.h"
#include "tenon/engines/simulation.h"
#include "tenon/engines/steering.h"

namespace tenon::engines {
namespace {

using Simulations = std::vector<std::unique_ptr<Simulation>>;

Result<Simulations> make_simulations(const Engine& engine, const scene::PhysicsScene& scene,
                                     const EnvironmentOptions& options, Diagnostics& diagnostics) {
  SimulationOptions simulation_options = options.simulation;
  simulation_options.outputs = with_needs_of_sensors(simulation_options.outputs, scene);
  if (engine.make_many != nullptr) {
    return engine.make_many(scene, simulation_options, options.count, diagnostics);
  }
  Simulations made;
  for (std::size_t i = 0; i < options.count; ++i) {
    Diagnostics again;  // what there is to say the first one says
    TENON_TRY(auto simulation,
              engine.make(scene, simulation_options, i == 0 ? diagnostics : again));
    made.push_back(std::move(simulation));
  }
  return made;
}

Result<void> check_count(std::size_t count) {
  if (count == 0 || count > limits::kEnvironments) {
    return Error(ErrorCode::Limit, std::to_string(count) + " environments are not between 1 and " +
                                       std::to_string(limits::kEnvironments))
        .with_rule("engine.environments");
  }
  return {};
}

}  // namespace

Result<Environments> Environments::make(const Engine& engine, const scene::PhysicsScene& scene,
                                        const EnvironmentOptions& options,
                                        Diagnostics& diagnostics) {
  TENON_CHECK(check_count(options.count));
  TENON_TRY(Simulations made, make_simulations(engine, scene, options, diagnostics));
  std::vector<World> worlds;
  for (std::unique_ptr<Simulation>& simulation : made) {
    TENON_TRY(World world, World::with_sensors(std::move(simulation), scene));
    worlds.push_back(std::move(world));
  }
  return of_worlds(std::move(worlds), scene, options.threads);
}

Result<Environments> Environments::of_worlds(std::vector<World> worlds,
                                             const scene::PhysicsScene& scene,
                                             std::size_t threads) {
  TENON_CHECK(check_count(worlds.size()));
  Environments result;
  result.worlds_ = std::move(worlds);
  const std::size_t count = result.worlds_.size();
  result.failures_.resize(count);
  result.threads_ = std::clamp<std::size_t>(threads == 0 ? usable_processors() : threads, 1, count);
  result.joint_count_ = scene.joints.size();
  for (scene::Index j = 0; j < scene.joints.size(); ++j) {
    result.coordinate_count_ += result.worlds_.front().joint_state(j).position.size();
    for (scene::Index d = 0; d < scene.joints[j].drives.size(); ++d) {
      result.drives_.push_back({j, d});
    }
  }
  return result;
}

Result<Environments> Environments::joined(std::vector<Environments> parts,
                                          const scene::PhysicsScene& scene, std::size_t threads) {
  std::vector<World> worlds;
  for (Environments& part : parts) {
    std::move(part.worlds_.begin(), part.worlds_.end(), std::back_inserter(worlds));
  }
  return of_worlds(std::move(worlds), scene, threads);
}

std::size_t Environments::step(std::size_t count) {
  run_each(threads_, [&](std::size_t thread) {
    for (std::size_t i = thread; i < worlds_.size(); i += threads_) {
      if (failures_[i].has_value()) {
        continue;
      }
      if (Result<void> done = worlds_[i].step(count); !done) {
        failures_[i] = std::move(done).error();
      }
    }
  });
  return static_cast<std::size_t>(
      std::count_if(failures_.begin(), failures_.end(),
                    [](const std::optional<Error>& failure) { return failure.has_value(); }));
}

const Error* Environments::failure(std::size_t i) const {
  return failures_[i].has_value() ? &*failures_[i] : nullptr;
}

Result<void> Environments::reset(std::size_t i) {
  TENON_CHECK(worlds_[i].reset());
  failures_[i].reset();
  return {};
}

Result<void> Environments::read_joints(std::span<double> positions,
                                       std::span<double> velocities) const {
  const std::size_t wanted = worlds_.size() * coordinate_count_;
  if (positions.size() != wanted || velocities.size() != wanted) {
    return bad_argument("positions and velocities must have " + std::to_string(wanted) +
                        " numbers each");
  }
  std::size_t at = 0;
  for (const World& world : worlds_) {
    for (scene::Index j = 0; j < joint_count_; ++j) {
      const JointState state = world.joint_state(j);
      for (std::size_t i = 0; i < state.position.size() && at < wanted; ++i, ++at) {
        positions[at] = state.position[i];
        velocities[at] = state.velocity[i];
      }
    }
  }
  return {};
}

Result<void> Environments::set_drive_positions(std::span<const double> targets) {
  const std::size_t wanted = worlds_.size() * drives_.size();
  if (targets.size() != wanted) {
    return bad_argument("targets must have " + std::to_string(wanted) + " numbers");
  }
  for (std::size_t at = 0; at < wanted; ++at) {
    const DriveAt& drive = drives_[at % drives_.size()];
    Result<void> done =
        worlds_[at / drives_.size()].set_drive_target(drive.joint, drive.drive, {targets[at], 0});
    if (!done && done.error().code() != ErrorCode::Unsupported) {
      return done;
    }
  }
  return {};
}

}  // namespace tenon::engines
