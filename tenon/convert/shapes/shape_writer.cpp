// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A shape is one prim, or one for each part of its mesh below a prim that holds them. Visuals and
// colliders are written alike and differ in what the prims are used for: a look is bound to a
// visual; a collider collides, is a guide and has a surface. Names are unique among all children of
// a link's prim, the links below it included.
#include "tenon/convert/shapes/shape_writer.h"

#include <filesystem>

#include "tenon/convert/contacts.h"
#include "tenon/convert/shapes/cameras.h"
#include "tenon/convert/shapes/ellipsoid.h"
#include "tenon/convert/shapes/gprims.h"

namespace tenon::convert {

using layer::Value;
using layer::Variability;
using robot::GeometryKind;
using robot::Index;

namespace {

const char* approximation_name(robot::Approximation approximation) {
  switch (approximation) {
    case robot::Approximation::Decomposition:
      return "convexDecomposition";
    case robot::Approximation::Sphere:
      return "boundingSphere";
    case robot::Approximation::None:
      return "none";
    case robot::Approximation::Hull:
      break;
  }
  return "convexHull";
}

}  // namespace

ShapeWriter::ShapeWriter(const Source& source, const LinkPrims& links, MaterialWriter& materials,
                         RobotLayer& layer)
    : source_(source),
      links_(links),
      materials_(materials),
      layer_(layer),
      meshes_(source, materials, layer) {
  prims_.contact_members.resize(source.model.contact_classes.size());
}

void ShapeWriter::write(Index link) {
  const robot::Link& described = source_.model.links[link];
  const Path prim = links_[link].path;
  NameScope names;
  for (const Index joint : source_.tree.child_joints[link]) {
    names.make(links_[source_.model.joints[joint].child].path.name().view());
  }
  for (const robot::Visual& visual : described.visuals) {
    const Shape shape{shape_name(visual.name, visual.geometry), visual.pose, visual.geometry,
                      visual.material};
    prims_.shapes.emplace(visual.name, write_shape(prim, shape, names));
  }
  for (const robot::Collider& collider : described.colliders) {
    const Shape shape{shape_name(collider.name, collider.geometry), collider.pose,
                      collider.geometry, std::nullopt, &collider};
    prims_.shapes.emplace(collider.name, write_shape(prim, shape, names));
  }
  for (const robot::Site& site : described.sites) {
    write_site(prim, site, names);
  }
  for (const robot::Camera& camera : described.cameras) {
    prims_.cameras.emplace(camera.name, write_camera(layer_, links_, prim, names, camera));
  }
  for (const robot::Light& light : described.lights) {
    write_light(layer_, links_, prim, names, light);
  }
}

/// How a shape is called: as the description says, else by its mesh file or its kind.
std::string ShapeWriter::shape_name(const std::string& name,
                                    const robot::Geometry& geometry) const {
  if (!name.empty()) {
    return name;
  }
  if (geometry.kind == GeometryKind::Mesh) {
    return std::filesystem::path(source_.model.meshes[geometry.mesh].written).stem().string();
  }
  return std::string(robot::geometry_name(geometry.kind));
}

/// Empty where there is nothing to show.
Path ShapeWriter::write_shape(Path link, const Shape& shape, NameScope& names) {
  if (shape.geometry.kind == GeometryKind::Mesh) {
    return write_parts(link, shape, names);
  }
  const Token name = names.make(shape.name);
  const bool hull = is_hull(shape);
  const Path prim =
      hull ? write_ellipsoid(layer_, link, name, shape.geometry.half_extents, shape.pose)
           : write_gprim(layer_, link, name, shape.geometry, shape.pose);
  layer_.show_name(prim, shape.name);
  write_use(prim, shape, shape.material);
  return prim;
}

Path ShapeWriter::write_parts(Path link, const Shape& shape, NameScope& names) {
  const std::vector<MeshValues>& parts = meshes_.parts(shape.geometry.mesh);
  if (parts.empty()) {
    return {};
  }
  const bool single = parts.size() == 1;
  const Path top = layer_.define(link, names, shape.name, single ? "Mesh" : "Xform");
  layer_.set_pose(top, shape.pose, shape.geometry.scale);
  NameScope part_names;
  for (const MeshValues& part : parts) {
    const Path prim =
        single ? top
               : layer_.define(top, part_names, part.name.empty() ? "part" : part.name, "Mesh");
    write_mesh(layer_.builder(), prim, part);
    write_use(prim, shape, shape.material ? shape.material : part.material);
  }
  return top;
}

bool ShapeWriter::is_hull(const Shape& shape) {
  return shape.collider != nullptr && shape.geometry.kind == GeometryKind::Ellipsoid;
}

void ShapeWriter::write_use(Path prim, const Shape& shape, std::optional<Index> material) {
  if (shape.collider == nullptr) {
    if (material) {
      materials_.bind_look(prim, *material);
    }
    return;
  }
  layer_.builder().apply(prim, "PhysicsCollisionAPI");
  if (shape.geometry.kind == GeometryKind::Mesh || is_hull(shape)) {
    layer_.builder().apply(prim, "PhysicsMeshCollisionAPI");
    layer_.builder().set_value(prim, "PhysicsMeshCollisionAPI", "physics:approximation",
                               Value(Token(approximation_name(shape.collider->approximation))));
  }
  write_collider(prim, *shape.collider);
}

void ShapeWriter::write_collider(Path prim, const robot::Collider& collider) {
  write_mujoco_contact(layer_.builder(), prim, collider.mujoco, source_.options.schema);
  if (collider.contact_class) {
    prims_.contact_members[*collider.contact_class].push_back(prim);
  }
  layer_.builder().set_attribute(prim, "purpose", "token", Value(Token("guide")),
                                 Variability::Uniform);
  if (!collider.surface.is_default()) {
    materials_.bind_surface(prim, collider.surface);
  }
}

void ShapeWriter::write_site(Path link, const robot::Site& site, NameScope& names) {
  const Token name = names.make(site.name.empty() ? "site" : site.name);
  const Path path = layer_.builder().define(link, name, "Xform");
  layer_.show_name(path, site.name);
  layer_.set_pose(path, site.pose);
  layer_.builder().apply(path, "IsaacSiteAPI");
  if (site.volume) {
    const auto& size = site.volume->size;
    layer_.builder().set_custom(path, "tenon:mujoco:type", "token",
                                layer::Value(Token(site.volume->type)));
    layer_.builder().set_custom(path, "tenon:mujoco:size", "double[]",
                                layer::Value(std::vector<double>(size.begin(), size.end())));
  }
  prims_.sites.emplace(site.name, path);
}

}  // namespace tenon::convert
