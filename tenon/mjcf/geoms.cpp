// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tenon/engines/mujoco/model.h"
#include "tenon/mjcf/mjcf_reader.h"

namespace tenon::mjcf {

using engines::mujoco::read_quaternion;
using engines::mujoco::read_vector;
using robot::GeometryKind;
using robot::Index;

namespace {

constexpr int kLastVisibleGroup = 2;  // groups 3 to 5 are hidden unless asked for
const double kDefaultFriction[3] = {1, 0.005, 0.0001};

}  // namespace

/// MuJoCo counts v from the upper edge of an image.
void MjcfReader::read_texture_coordinates(int mesh, robot::MeshFile& file) const {
  const int start = model_.mesh_texcoordadr[mesh];
  if (start < 0) {
    return;
  }
  const float* places = model_.mesh_texcoord + 2 * static_cast<std::size_t>(start);
  const int* corners =
      model_.mesh_facetexcoord + 3 * static_cast<std::size_t>(model_.mesh_faceadr[mesh]);
  for (std::size_t i = 0; i < 3 * file.triangles.size(); ++i) {
    const float* place = places + 2 * static_cast<std::size_t>(corners[i]);
    file.texture_coordinates.push_back({{place[0], 1 - place[1]}});
  }
}

/// Vertices as MuJoCo has them: about the centre and in the principal axes of the mesh, which is
/// where its geoms stand.
void MjcfReader::read_meshes() {
  for (int mesh = 0; mesh < model_.nmesh; ++mesh) {
    robot::MeshFile& file = robot_.meshes.emplace_back();
    file.written = unique_name(mjOBJ_MESH, mesh, "mesh");
    const float* vertices =
        model_.mesh_vert + 3 * static_cast<std::size_t>(model_.mesh_vertadr[mesh]);
    for (int i = 0; i < model_.mesh_vertnum[mesh]; ++i) {
      const float* v = vertices + 3 * static_cast<std::size_t>(i);
      file.points.push_back({{v[0], v[1], v[2]}});
    }
    const int* faces = model_.mesh_face + 3 * static_cast<std::size_t>(model_.mesh_faceadr[mesh]);
    for (int i = 0; i < model_.mesh_facenum[mesh]; ++i) {
      const int* f = faces + 3 * static_cast<std::size_t>(i);
      file.triangles.push_back({{f[0], f[1], f[2]}});
    }
    read_texture_coordinates(mesh, file);
  }
}

bool MjcfReader::read_shape(int geom, robot::Geometry& geometry) {
  const double* size = model_.geom_size + 3 * static_cast<std::size_t>(geom);
  geometry.half_extents = read_vector(size);
  geometry.radius = size[0];
  geometry.half_height = size[1];
  switch (model_.geom_type[geom]) {
    case mjGEOM_PLANE:
      geometry.kind = GeometryKind::Plane;
      return true;
    case mjGEOM_SPHERE:
      geometry.kind = GeometryKind::Sphere;
      return true;
    case mjGEOM_CAPSULE:
      geometry.kind = GeometryKind::Capsule;
      return true;
    case mjGEOM_ELLIPSOID:
      geometry.kind = GeometryKind::Ellipsoid;
      return true;
    case mjGEOM_CYLINDER:
      geometry.kind = GeometryKind::Cylinder;
      return true;
    case mjGEOM_BOX:
      geometry.kind = GeometryKind::Box;
      return true;
    case mjGEOM_MESH:
      geometry.kind = GeometryKind::Mesh;
      geometry.mesh = static_cast<Index>(model_.geom_dataid[geom]);
      return model_.geom_dataid[geom] >= 0;
    default:
      return false;
  }
}

void MjcfReader::read_geom(int geom) {
  const auto at = static_cast<std::size_t>(geom);
  const std::string shown = unique_name(mjOBJ_GEOM, geom, "geom");
  const std::string name = wrapped_[at] != 0 ? shown : name_of(mjOBJ_GEOM, geom);
  robot::Geometry geometry;
  if (!read_shape(geom, geometry)) {
    report("mjcf.left-out",
           "the geom \"" + shown +
               "\" is a height field or a distance field; it "
               "is left out",
           Severity::Error);
    return;
  }
  robot::Link& link = robot_.links[link_of_body_[static_cast<std::size_t>(model_.geom_bodyid[at])]];
  const Pose pose{read_vector(model_.geom_pos + 3 * at),
                  read_quaternion(model_.geom_quat + 4 * at)};
  if (!collides(geom) || model_.geom_group[at] <= kLastVisibleGroup) {
    link.visuals.push_back({name, pose, geometry, material_of(geom, geometry), 0});
  }
  if (!collides(geom)) {
    return;
  }
  robot::Collider collider;
  collider.contact_class = class_of_geom_[at];
  collider.mujoco = contact_of(geom);
  collider.name = name.empty() ? "" : name + "_collider";
  collider.pose = pose;
  collider.geometry = geometry;
  const double* friction = model_.geom_friction + 3 * at;
  if (!std::equal(friction, friction + 3, kDefaultFriction)) {
    collider.surface.static_friction = friction[0];
    collider.surface.dynamic_friction = friction[0];
    collider.surface.torsional_friction = friction[1];
    collider.surface.rolling_friction = friction[2];
  } else {
    collider.surface.static_friction = 1;
    collider.surface.dynamic_friction = 1;
  }
  link.colliders.push_back(std::move(collider));
}

void MjcfReader::read_geoms() {
  find_wrapped_geoms();
  find_contact_classes();
  for (int geom = 0; geom < model_.ngeom; ++geom) {
    read_geom(geom);
  }
}

}  // namespace tenon::mjcf
