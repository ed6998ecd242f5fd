// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

#include "tenon/layer/layer.h"

namespace tenon::physics {

/// What `strip_physics` took out of a layer.
struct StripCounts {
  std::size_t prims = 0;        ///< scenes, joints, collision groups and the like
  std::size_t api_schemas = 0;  ///< entries of apiSchemas lists
  std::size_t properties = 0;
  std::size_t metadata = 0;  ///< kilogramsPerUnit of the layer

  std::size_t total() const { return prims + api_schemas + properties + metadata; }
};

/// The type or API schema (with or without instance) belongs to physics: UsdPhysics, PhysX, Newton,
/// MuJoCo.
bool is_physics_schema(std::string_view name);
/// The property belongs to physics: of such a schema, of Isaac's joint offsets (isaac:physics:*),
/// or a binding of materials for physics.
bool is_physics_property(std::string_view name);

/// Takes all physics out of one layer, variants and classes included (S-119): prims of physics
/// types, entries of apiSchemas, properties, the unit of mass. A prim of a physics type with
/// children that are none stays, without its type. Overs that are empty after it go too. All else
/// stays as it is; what named a removed prim names nothing now.
StripCounts strip_physics(layer::Layer& layer);

}  // namespace tenon::physics
