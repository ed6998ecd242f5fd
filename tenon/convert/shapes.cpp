// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "tenon/convert/conversion.h"
#include "tenon/mesh/read_mesh.h"

namespace tenon::convert {

using layer::Value;
using layer::Variability;
using robot::GeometryKind;
using robot::Index;

namespace {

Value box_extent(const Vec3d& half) {
  return Value(std::vector<Vec3f>{to_float(-half), to_float(half)});
}

Value extent_of(const std::vector<Vec3f>& points) {
  Vec3f low = points.empty() ? Vec3f{} : points.front();
  Vec3f high = low;
  for (const Vec3f& point : points) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], point[i]);
      high[i] = std::max(high[i], point[i]);
    }
  }
  return Value(std::vector<Vec3f>{low, high});
}

/// Of flat faces, for a mesh that brings none: polygons that no subdivision rounds are to have some
/// (UsdGeomMesh). Along +Z where a face has no area.
std::vector<Vec3f> face_normals(const mesh::PolygonMesh& mesh) {
  std::vector<Vec3f> normals;
  normals.reserve(mesh.face_counts.size());
  const Vec3f* const points = mesh.points.data();
  const std::int32_t* corner = mesh.face_points.data();
  for (const std::int32_t count : mesh.face_counts) {
    const Vec3d first = to_double(points[corner[0]]);
    Vec3d area;
    Vec3d before = to_double(points[corner[1]]) - first;
    for (std::int32_t i = 2; i < count; ++i) {
      const Vec3d next = to_double(points[corner[i]]) - first;
      area = area + cross(before, next);
      before = next;
    }
    const double size = length(area);
    normals.push_back(size > 0 ? to_float(area * (1 / size)) : Vec3f{{0, 0, 1}});
    corner += count;
  }
  return normals;
}

mesh::PolygonMesh polygons_of(const robot::MeshFile& file) {
  mesh::PolygonMesh mesh;
  mesh.points = file.points;
  mesh.face_counts.assign(file.triangles.size(), 3);
  for (const Vec3i& triangle : file.triangles) {
    mesh.face_points.insert(mesh.face_points.end(), triangle.v.begin(), triangle.v.end());
  }
  mesh.texture_coordinates = file.texture_coordinates;
  return mesh;
}

}  // namespace

MeshValues Conversion::values_of(mesh::PolygonMesh mesh,
                                 const std::vector<Index>& materials) const {
  MeshValues values;
  values.name = mesh.name;
  values.extent = extent_of(mesh.points);
  values.normals_interpolation = mesh.normals.empty() ? "uniform" : "faceVarying";
  values.normals = Value(mesh.normals.empty() ? face_normals(mesh) : std::move(mesh.normals));
  values.points = Value(std::move(mesh.points));
  values.face_counts = Value(std::move(mesh.face_counts));
  values.face_points = Value(std::move(mesh.face_points));
  if (!mesh.texture_coordinates.empty()) {
    values.texture_coordinates = Value(std::move(mesh.texture_coordinates));
  }
  if (mesh.appearance) {
    values.material = materials[*mesh.appearance];
  }
  return values;
}

const std::vector<MeshValues>& Conversion::mesh_values(Index mesh) {
  const auto [at, is_new] = meshes_.try_emplace(mesh);
  const robot::MeshFile& file = model_.meshes[mesh];
  if (!is_new) {
    return at->second;
  }
  if (!file.triangles.empty()) {
    at->second.push_back(values_of(polygons_of(file), {}));
    return at->second;
  }
  if (file.path.empty()) {
    return at->second;
  }
  Result<mesh::MeshScene> scene =
      mesh::read_mesh(file.path, {workers_, options_.reading}, diagnostics_);
  if (!scene) {
    const bool outside = scene.error().diagnostic().rule == bytes::kOutsideRule;
    report(file.place, Severity::Error, outside ? bytes::kOutsideRule : "convert.mesh-unreadable",
           "the mesh \"" + file.written +
               "\" cannot be read and is left out: " + scene.error().to_string(),
           scene.error().diagnostic().fix);
    return at->second;
  }
  images_.merge(scene->images);
  std::vector<Index> materials;
  for (const mesh::Appearance& appearance : scene->appearances) {
    materials.push_back(add_material(appearance));
  }
  for (mesh::PolygonMesh& part : scene->meshes) {
    at->second.push_back(values_of(std::move(part), materials));
  }
  return at->second;
}

void Conversion::write_mesh(Path prim, const MeshValues& mesh) {
  builder_.set_value(prim, "Mesh", "extent", mesh.extent);
  builder_.set_value(prim, "Mesh", "faceVertexCounts", mesh.face_counts);
  builder_.set_value(prim, "Mesh", "faceVertexIndices", mesh.face_points);
  builder_.set_value(prim, "Mesh", "normals", mesh.normals);
  builder_.set_metadata(prim.property("normals"), "interpolation",
                        Value(Token(mesh.normals_interpolation)));
  builder_.set_value(prim, "Mesh", "points", mesh.points);
  if (!mesh.texture_coordinates.empty()) {
    builder_.set_attribute(prim, "primvars:st", "texCoord2f[]", mesh.texture_coordinates);
    builder_.set_metadata(prim.property("primvars:st"), "interpolation",
                          Value(Token("faceVarying")));
  }
  builder_.set_value(prim, "Mesh", "subdivisionScheme", Value(Token("none")));
}

/// A shape of no mesh.
Path Conversion::write_gprim(Path link, Token name, const Pose& pose,
                             const robot::Geometry& geometry) {
  const double r = geometry.radius;
  const double h = geometry.half_height;
  const Vec3d& half = geometry.half_extents;
  Path prim;
  Vec3d scale{{1, 1, 1}};
  switch (geometry.kind) {
    case GeometryKind::Box:
      prim = builder_.define(link, name, "Cube");
      builder_.set_value(prim, "Cube", "extent", box_extent({{0.5, 0.5, 0.5}}));
      builder_.set_number(prim, "Cube", "size", 1);
      scale = half * 2.0;
      break;
    case GeometryKind::Sphere:
      prim = builder_.define(link, name, "Sphere");
      builder_.set_value(prim, "Sphere", "extent", box_extent({{r, r, r}}));
      builder_.set_number(prim, "Sphere", "radius", r);
      break;
    case GeometryKind::Ellipsoid:
      prim = builder_.define(link, name, "Sphere");
      builder_.set_value(prim, "Sphere", "extent", box_extent({{1, 1, 1}}));
      builder_.set_number(prim, "Sphere", "radius", 1);
      scale = half;
      break;
    case GeometryKind::Cylinder:
    case GeometryKind::Capsule: {
      const bool capsule = geometry.kind == GeometryKind::Capsule;
      const Token type(capsule ? "Capsule" : "Cylinder");
      prim = builder_.define(link, name, type);
      builder_.set_value(prim, type, "axis", Value(Token("Z")));
      builder_.set_value(prim, type, "extent", box_extent({{r, r, capsule ? h + r : h}}));
      builder_.set_number(prim, type, "height", 2 * h);
      builder_.set_number(prim, type, "radius", r);
      break;
    }
    case GeometryKind::Plane:
      prim = builder_.define(link, name, "Plane");
      builder_.set_value(prim, "Plane", "axis", Value(Token("Z")));
      if (half[0] > 0 && half[1] > 0) {
        builder_.set_number(prim, "Plane", "width", 2 * half[0]);
        builder_.set_number(prim, "Plane", "length", 2 * half[1]);
      }
      break;
    case GeometryKind::Mesh:
      break;
  }
  write_pose(prim, pose, scale);
  return prim;
}

void Conversion::write_collider(Path prim, const robot::Collider& collider, bool is_mesh) {
  builder_.apply(prim, "PhysicsCollisionAPI");
  if (is_mesh) {
    builder_.apply(prim, "PhysicsMeshCollisionAPI");
    builder_.set_value(prim, "PhysicsMeshCollisionAPI", "physics:approximation",
                       Value(Token("convexHull")));
  }
  write_mujoco_contact(prim, collider.mujoco);
  if (collider.contact_class) {
    contact_members_[*collider.contact_class].push_back(prim);
  }
  builder_.set_attribute(prim, "purpose", "token", Value(Token("guide")), Variability::Uniform);
  if (!collider.surface.is_default()) {
    bind(prim, "material:binding:physics", surface_path(collider.surface));
  }
}

Path Conversion::write_shape(Path link, const std::string& name, const Pose& pose,
                             const robot::Geometry& geometry, std::optional<Index> material,
                             const robot::Collider* collider, NameScope& names) {
  const auto finish = [&](Path prim, std::optional<Index> own, bool is_mesh) {
    if (collider != nullptr) {
      write_collider(prim, *collider, is_mesh);
    } else if (own) {
      bind(prim, "material:binding", material_path(*own));
    }
  };
  if (geometry.kind != GeometryKind::Mesh) {
    const Token legal = names.make(name);
    const Path prim = write_gprim(link, legal, pose, geometry);
    name_prim(prim, legal, name);
    finish(prim, material, false);
    return prim;
  }
  const std::vector<MeshValues>& parts = mesh_values(geometry.mesh);
  if (parts.empty()) {
    return {};
  }
  const bool single = parts.size() == 1;
  const Token legal = names.make(name);
  const Path top = builder_.define(link, legal, single ? "Mesh" : "Xform");
  name_prim(top, legal, name);
  write_pose(top, pose, geometry.scale);
  NameScope part_names;
  for (const MeshValues& part : parts) {
    Path prim = top;
    if (!single) {
      const std::string part_name = part.name.empty() ? "part" : part.name;
      const Token part_token = part_names.make(part_name);
      prim = builder_.define(top, part_token, "Mesh");
      name_prim(prim, part_token, part_name);
    }
    write_mesh(prim, part);
    finish(prim, material ? material : part.material, true);
  }
  return top;
}

namespace {

/// How a shape is called: as the description says, else by its mesh file or its kind.
std::string shape_name(const std::string& name, const robot::Geometry& geometry,
                       const robot::RobotModel& model) {
  if (!name.empty()) {
    return name;
  }
  if (geometry.kind == GeometryKind::Mesh) {
    return std::filesystem::path(model.meshes[geometry.mesh].written).stem().string();
  }
  return std::string(robot::geometry_name(geometry.kind));
}

}  // namespace

void Conversion::write_shapes(Index link) {
  const robot::Link& source = model_.links[link];
  const Path prim = links_[link].path;
  NameScope names;
  for (const Index joint : tree_.child_joints[link]) {
    names.make(links_[model_.joints[joint].child].path.name().view());
  }
  for (const robot::Visual& visual : source.visuals) {
    const Path path = write_shape(prim, shape_name(visual.name, visual.geometry, model_),
                                  visual.pose, visual.geometry, visual.material, nullptr, names);
    shape_paths_.emplace(visual.name, path);
  }
  for (const robot::Collider& collider : source.colliders) {
    const Path path = write_shape(prim, shape_name(collider.name, collider.geometry, model_),
                                  collider.pose, collider.geometry, std::nullopt, &collider, names);
    shape_paths_.emplace(collider.name, path);
  }
  for (const robot::Site& site : source.sites) {
    const Token name = names.make(site.name.empty() ? "site" : site.name);
    const Path path = builder_.define(prim, name, "Xform");
    name_prim(path, name, site.name);
    write_pose(path, site.pose, {{1, 1, 1}});
    builder_.apply(path, "IsaacSiteAPI");
    site_paths_.emplace(site.name, path);
  }
}

}  // namespace tenon::convert
