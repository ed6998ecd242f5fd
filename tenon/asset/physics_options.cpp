// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/physics_options.h"

#include "tenon/approximate/mesh_approximator.h"

namespace tenon {

OpenOptions with_readings(OpenOptions options, const physics::Readings& readings) {
  options.layer_units = readings.layer_units == physics::LayerUnits::Layer;
  return options;
}

physics::ReadOptions read_options(const physics::Readings& readings) {
  physics::ReadOptions options;
  options.readings = readings;
  options.mesh_tools = approximate::mesh_tools({approximate::default_cache_folder()});
  return options;
}

}  // namespace tenon
