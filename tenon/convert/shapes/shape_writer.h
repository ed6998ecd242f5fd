// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tenon/convert/link_prims.h"
#include "tenon/convert/robot_layer.h"
#include "tenon/convert/shapes/material_writer.h"
#include "tenon/convert/shapes/mesh_table.h"

/// Internal to this folder.
namespace tenon::convert {

/// What shapes and sites are on the stage.
struct ShapePrims {
  std::map<std::string, Path> sites;               ///< by name; the first of that name
  std::map<std::string, Path> shapes;              ///< visuals and colliders that have names
  std::map<std::string, Path> cameras;             ///< by name; the first of that name
  std::vector<std::vector<Path>> contact_members;  ///< (contact_class_count), colliders
};

/// Writes what links look like, touch with and are measured by.
class ShapeWriter {
 public:
  /// All of it outlives this.
  ShapeWriter(const Source& source, const LinkPrims& links, MaterialWriter& materials,
              RobotLayer& layer);

  /// Visuals, colliders and sites of a link, below its prim.
  void write(robot::Index link);

  /// Those written so far.
  const ShapePrims& prims() const { return prims_; }

 private:
  /// A visual or a collider to write.
  struct Shape {
    std::string name;
    const Pose& pose;
    const robot::Geometry& geometry;
    std::optional<robot::Index> material;
    const robot::Collider* collider = nullptr;  ///< none: a visual
  };

  /// An ellipsoid that collides is a mesh.
  static bool is_hull(const Shape& shape);
  Path write_shape(Path link, const Shape& shape, NameScope& names);
  Path write_parts(Path link, const Shape& shape, NameScope& names);
  void write_use(Path prim, const Shape& shape, std::optional<robot::Index> material);
  void write_collider(Path prim, const robot::Collider& collider);
  void write_site(Path link, const robot::Site& site, NameScope& names);
  std::string shape_name(const std::string& name, const robot::Geometry& geometry) const;

  const Source& source_;
  const LinkPrims& links_;
  MaterialWriter& materials_;
  RobotLayer& layer_;
  MeshTable meshes_;
  ShapePrims prims_;
};

}  // namespace tenon::convert
