// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/engines/mujoco/model.h"
#include "tenon/engines/mujoco/mujoco_library.h"
#include "tenon/scene/mujoco_actuators.h"
#include "tenon/scene/physics_scene.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// Adds MuJoCo's own sensors of an asset to the spec of its model, named after their prims. One
/// whose instrument was moved since measures there. Those that the model has no object for, whose
/// instrument is gone or off, or that MuJoCo refuses, are listed.
class KeptSensorWriter {
 public:
  /// `geoms` show prims, by their paths. All of it outlives this.
  KeptSensorWriter(const scene::PhysicsScene& scene, const engines::mujoco::Model& model,
                   const std::map<std::string, mjsGeom*>& geoms, mjSpec& spec,
                   Diagnostics& diagnostics);

  /// Adds them. -> paths of the instruments that need not be written any more.
  std::set<Path> add(const std::vector<scene::MujocoSensor>& sensors);

  /// Whether the spec compiles now. Errors: those of MuJoCo.
  using Compiles = std::function<Result<bool>()>;
  /// After MuJoCo has refused the model: takes all out that were added, and puts those back that it
  /// takes. False: it refuses the model without them too, and they are out.
  Result<bool> retry(const Compiles& compiles);

 private:
  struct Made {
    const scene::MujocoSensor* from;
    mjsElement* element;
  };

  std::string fault_of(const scene::MujocoSensor& from, const scene::Sensor* instrument) const;
  std::string make(const scene::MujocoSensor& from, mjsSensor& made);
  std::string set_object(const scene::MujocoSensor& from, mjsSensor& made);
  std::string name_of(mjtObj kind, Path prim) const;
  std::string joint_name(Path prim) const;
  std::string body_name(Path prim) const;
  std::string geom_name(Path prim) const;
  bool is_at(const scene::Sensor& instrument, const std::string& site) const;
  const scene::Sensor* instrument_of(const scene::MujocoSensor& from) const;
  mjsElement* add(const scene::MujocoSensor& from);

  const scene::PhysicsScene& scene_;
  const engines::mujoco::Model& model_;
  const std::map<std::string, mjsGeom*>& geoms_;
  mjSpec& spec_;
  Diagnostics& diagnostics_;
  std::vector<Made> made_;
};

}  // namespace tenon::mjcf
