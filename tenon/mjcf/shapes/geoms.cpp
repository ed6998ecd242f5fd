// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mjcf/shapes/geoms.h"

#include <algorithm>

#include "tenon/engines/mujoco/model.h"
#include "tenon/mjcf/softness.h"
#include "tenon/mjcf/tendons.h"

namespace tenon::mjcf {

using engines::mujoco::read_quaternion;
using engines::mujoco::read_vector;
using robot::GeometryKind;
using robot::Index;

namespace {

constexpr int kLastVisibleGroup = 2;  // groups 3 to 5 are hidden unless asked for
const double kDefaultFriction[3] = {1, 0.005, 0.0001};

/// None for height fields and distance fields.
std::optional<robot::Geometry> read_shape(const mjModel& model, int geom) {
  robot::Geometry geometry;
  const double* size = model.geom_size + 3 * static_cast<std::size_t>(geom);
  geometry.half_extents = read_vector(size);
  geometry.radius = size[0];
  geometry.half_height = size[1];
  switch (model.geom_type[geom]) {
    case mjGEOM_PLANE:
      geometry.kind = GeometryKind::Plane;
      return geometry;
    case mjGEOM_SPHERE:
      geometry.kind = GeometryKind::Sphere;
      return geometry;
    case mjGEOM_CAPSULE:
      geometry.kind = GeometryKind::Capsule;
      return geometry;
    case mjGEOM_ELLIPSOID:
      geometry.kind = GeometryKind::Ellipsoid;
      return geometry;
    case mjGEOM_CYLINDER:
      geometry.kind = GeometryKind::Cylinder;
      return geometry;
    case mjGEOM_BOX:
      geometry.kind = GeometryKind::Box;
      return geometry;
    case mjGEOM_MESH:
      geometry.kind = GeometryKind::Mesh;
      geometry.mesh = static_cast<Index>(model.geom_dataid[geom]);
      return model.geom_dataid[geom] >= 0 ? std::optional(geometry) : std::nullopt;
    default:
      return std::nullopt;
  }
}

robot::Surface surface_of(const double* friction) {
  robot::Surface surface;
  surface.static_friction = friction[0];
  surface.dynamic_friction = friction[0];
  if (!std::equal(friction, friction + 3, kDefaultFriction)) {
    surface.torsional_friction = friction[1];
    surface.rolling_friction = friction[2];
  }
  return surface;
}

robot::Collider collider_of(const mjModel& model, int geom, const robot::Visual& seen) {
  robot::Collider collider;
  collider.mujoco = contact_of(model, geom);
  collider.name = seen.name.empty() ? "" : seen.name + "_collider";
  collider.pose = seen.pose;
  collider.geometry = seen.geometry;
  collider.surface = surface_of(model.geom_friction + 3 * static_cast<std::size_t>(geom));
  return collider;
}

/// Name, pose and geometry of a geom; none and a finding where it is of another kind.
std::optional<robot::Visual> read_geom(MjcfSource& source, int geom, bool is_wrapped) {
  const mjModel& model = source.model();
  const auto at = static_cast<std::size_t>(geom);
  const std::string shown = source.name(mjOBJ_GEOM, geom, "geom");
  const std::optional<robot::Geometry> geometry = read_shape(model, geom);
  if (!geometry) {
    source.report(
        Severity::Error, "mjcf.left-out",
        "the geom \"" + shown + "\" is a height field or a distance field; it is skipped");
    return std::nullopt;
  }
  robot::Visual seen;
  seen.name = is_wrapped ? shown : source.written_name(mjOBJ_GEOM, geom);
  seen.pose = {read_vector(model.geom_pos + 3 * at), read_quaternion(model.geom_quat + 4 * at)};
  seen.geometry = *geometry;
  return seen;
}

}  // namespace

std::vector<BodyShapes> read_geoms(MjcfSource& source, const std::vector<robot::MeshFile>& meshes,
                                   const ContactClasses& contacts, MaterialTable& materials) {
  const mjModel& model = source.model();
  const std::vector<char> wrapped = wrapped_geoms(model);
  std::vector<BodyShapes> bodies(static_cast<std::size_t>(model.nbody));
  for (int geom = 0; geom < model.ngeom; ++geom) {
    const auto at = static_cast<std::size_t>(geom);
    std::optional<robot::Visual> seen = read_geom(source, geom, wrapped[at] != 0);
    if (!seen) {
      continue;
    }
    BodyShapes& shapes = bodies[static_cast<std::size_t>(model.geom_bodyid[at])];
    if (contacts.collides[at]) {
      robot::Collider& collider = shapes.colliders.emplace_back(collider_of(model, geom, *seen));
      collider.contact_class = contacts.of_geom[at];
    }
    if (!contacts.collides[at] || model.geom_group[at] <= kLastVisibleGroup) {
      const bool has_coordinates = seen->geometry.kind == GeometryKind::Mesh &&
                                   !meshes[seen->geometry.mesh].texture_coordinates.empty();
      seen->material = materials.of_geom(geom, has_coordinates);
      shapes.visuals.push_back(std::move(*seen));
    }
  }
  return bodies;
}

}  // namespace tenon::mjcf
