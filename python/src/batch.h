// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "interruptions.h"
#include <nanobind/nanobind.h>

#include "tenon/asset/many_environments/variation.h"
#include "tenon/base/diagnostics.h"
#include "tenon/dynamics/masks.h"
#include "tenon/engines/environments.h"
#include "tenon/open_stage.h"
#include "tenon/physics/readings.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"

namespace tenon::python {

/// How many environments are made.
struct BatchOptions {
  std::string engine;  ///< empty: as choose_engine() decides
  std::size_t count = 1;
  std::size_t threads = 0;  ///< 0: as many as this process may use
  std::uint64_t seed = 0;   ///< of what variations draw
  std::vector<std::string> variations;
  dynamics::Masks masks;  ///< links and joints that all environments skip or hold
  engines::SimulationOptions simulation{};
};

/// A number of the description, or all of a vector or a matrix, by the names of its tables.
struct FieldKey {
  std::string list;    ///< "bodies"
  std::string object;  ///< path
  std::string field;   ///< "centerOfMass"
  std::size_t count = 1;
};

/// One coordinate of a joint.
struct Coordinate {
  scene::Index joint = 0;
  std::size_t part = 0;  ///< of the joint's coordinates
};

/// Environments of one asset with all that they are made of. Whoever calls holds `mutex`, and not
/// the interpreter.
class Batch {
 public:
  static Result<std::unique_ptr<Batch>> make(const std::string& path, const OpenOptions& open,
                                             const physics::Readings& readings,
                                             const BatchOptions& options);

  std::size_t size() const { return environments->size(); }
  engines::World& world(std::size_t i) { return (*environments)[i]; }
  Result<void> reset(std::size_t i);
  /// What environment i draws from its next reset on: numbers for each variation, as many as it
  /// drew; of fields of the scene those that it has. Errors: Invalid.
  Result<void> set_drawn(std::size_t i, std::vector<std::vector<double>> numbers);
  /// Sets numbers of the description that engines do not change while they run; all others are as
  /// they were read or drawn, whatever was set before. All environments are made again, at their
  /// start; neighbours with the same numbers share a model. `values` has a
  /// row for each environment, of all fields one behind the other. Errors: NotFound where nothing
  /// has a field; those of making a simulation.
  Result<void> set_fields(const std::vector<FieldKey>& fields, std::span<const double> values);

  std::recursive_mutex mutex;  ///< again from handlers of signals, between two steps
  BlockStepper stepper;
  Diagnostics diagnostics;
  std::string engine;
  std::string engine_version;
  std::unique_ptr<stage::Stage> stage;
  OpenOptions open;
  std::string path;
  std::unique_ptr<scene::PhysicsScene> scene;
  /// Of each environment; none where fields are the same for all.
  std::vector<std::shared_ptr<scene::PhysicsScene>> own_scenes;
  engines::SimulationOptions simulation{};  ///< of every environment
  std::size_t threads = 0;                  ///< as in BatchOptions
  std::optional<engines::Environments> environments;
  std::vector<Coordinate> coordinates;  ///< (coordinate_count)
  std::vector<Coordinate> drives;       ///< (drive_count), parts into Joint::drives
  std::vector<Variation> variations;
  std::vector<std::vector<std::vector<double>>> drawn;  ///< (size, variation_count, ...)

 private:
  Result<void> vary(std::size_t i);
};

void bind_batch(nanobind::module_& module);

}  // namespace tenon::python
