// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Sizes that are missing are those of the format, 1 m. A plane lies across its normal, so its pose
// is turned. A mesh is known by its file and, where one part of it is meant, by that.
#include <cmath>

#include "tenon/math/shortest_turn.h"
#include "tenon/sdf/extruded.h"
#include "tenon/sdf/shape_reader.h"

namespace tenon::sdf {

using robot::Geometry;
using robot::GeometryKind;
using robot::Index;

namespace {

/// From +Z to a direction.
Quatd turn_of_normal(const Vec3d& normal) {
  const double size = length(normal);
  if (!(size > 0) || !std::isfinite(size)) {
    return kIdentityRotation;
  }
  const Vec3d n = normal * (1 / size);
  constexpr double kOpposite = 1e-12;
  if (1 + n[2] < kOpposite) {
    return {1, 0, 0, 0};
  }
  return shortest_turn({{0, 0, 1}}, n);
}

}  // namespace

Result<robot::Surface> read_surface(SdfFile& file, pugi::xml_node element) {
  robot::Surface surface;
  const pugi::xml_node friction = element.child("friction");
  const pugi::xml_node ode = friction.child("ode");
  file.list_skipped(element, {"friction", "bounce", "contact"}, {"soft_contact"});
  file.list_skipped(friction, {"ode", "torsional"}, {"bullet"});
  file.list_skipped(ode, {"mu", "mu2"}, {"fdir1", "slip1", "slip2"});
  if (ode.child("mu")) {
    TENON_TRY(const double along, file.number(ode, "mu", 1));
    TENON_TRY(const double across, file.number(ode, "mu2", along));
    surface.static_friction = along;
    surface.dynamic_friction = along;
    if (across != along) {
      file.warn(ode, "sdf.left-out",
                "has another friction across (mu2) than along (mu), which is used for both", "");
    }
  }
  if (friction.child("torsional")) {
    file.warn(friction.child("torsional"), "sdf.left-out",
              "is a setting of simulators, which is skipped", "", Severity::Info);
  }
  const pugi::xml_node bounce = element.child("bounce");
  if (bounce.child("restitution_coefficient")) {
    TENON_TRY(surface.restitution, file.number(bounce, "restitution_coefficient", 0));
  }
  file.list_skipped(bounce, {"restitution_coefficient"}, {"threshold"});
  const pugi::xml_node contact = element.child("contact");
  const pugi::xml_node spring = contact.child("ode");
  file.list_skipped(
      contact, {"ode"},
      {"collide_without_contact", "collide_without_contact_bitmask", "collide_bitmask",
       "category_bitmask", "poissons_ratio", "elastic_modulus", "bullet"});
  file.list_skipped(spring, {"kp", "kd"}, {"soft_cfm", "soft_erp", "max_vel", "min_depth"});
  constexpr double kHard = 1e12;  // what SDF has by default
  TENON_TRY(const double stiffness, file.number(spring, "kp", kHard));
  TENON_TRY(const double damping, file.number(spring, "kd", 1));
  if (stiffness > 0 && stiffness < kHard && damping >= 0) {
    surface.contact_stiffness = stiffness;
    surface.contact_damping = damping;
  }
  return surface;
}

Result<std::optional<Geometry>> ShapeReader::read_geometry(SdfFile& file, pugi::xml_node shape,
                                                           Pose& pose) {
  const pugi::xml_node outer = shape.child("geometry");
  for (const pugi::xml_node element : outer.children()) {
    const std::string kind = element.name();
    Geometry geometry;
    if (kind == "empty") {
      return std::optional<Geometry>();
    }
    if (kind == "box") {
      TENON_TRY(const std::vector<double> size, file.numbers(element, "size", {1, 1, 1}));
      geometry.half_extents = {{size[0] / 2, size[1] / 2, size[2] / 2}};
      return std::optional(geometry);
    }
    if (kind == "sphere" || kind == "cylinder" || kind == "capsule") {
      geometry.kind = kind == "sphere"     ? GeometryKind::Sphere
                      : kind == "cylinder" ? GeometryKind::Cylinder
                                           : GeometryKind::Capsule;
      TENON_TRY(geometry.radius, file.number(element, "radius", kind == "sphere" ? 1 : 0.5));
      TENON_TRY(const double length, file.number(element, "length", 1));
      geometry.half_height = kind == "sphere" ? 0 : length / 2;
      return std::optional(geometry);
    }
    if (kind == "ellipsoid") {
      geometry.kind = GeometryKind::Ellipsoid;
      TENON_TRY(const std::vector<double> radii, file.numbers(element, "radii", {1, 1, 1}));
      geometry.half_extents = {{radii[0], radii[1], radii[2]}};
      return std::optional(geometry);
    }
    if (kind == "plane") {
      geometry.kind = GeometryKind::Plane;
      TENON_TRY(const std::vector<double> size, file.numbers(element, "size", {1, 1}));
      TENON_TRY(const std::vector<double> normal, file.numbers(element, "normal", {0, 0, 1}));
      geometry.half_extents = {{size[0] / 2, size[1] / 2, 0}};
      pose.orientation = pose.orientation * turn_of_normal({{normal[0], normal[1], normal[2]}});
      return std::optional(geometry);
    }
    if (kind == "mesh") {
      return read_mesh(file, element);
    }
    if (kind == "polyline") {
      return read_polyline(file, outer);
    }
  }
  file.warn(outer ? outer : shape, "sdf.shape",
            (outer.first_child()
                 ? "the shape <" + std::string(outer.first_child().name()) + "> is unsupported"
                 : std::string("has no shape")) +
                "; the " + shape.name() + " is skipped",
            "give it a box, sphere, cylinder, capsule, ellipsoid, plane, polyline or mesh",
            Severity::Error);
  return std::optional<Geometry>();
}

Result<std::optional<Geometry>> ShapeReader::read_mesh(SdfFile& file, pugi::xml_node element) {
  file.list_skipped(element, {"uri", "scale", "submesh"}, {"convex_decomposition"});
  Geometry geometry;
  geometry.kind = GeometryKind::Mesh;
  const std::string uri = SdfFile::text_of(element.child("uri"));
  TENON_TRY(const std::vector<double> scale, file.numbers(element, "scale", {1, 1, 1}));
  geometry.scale = {{scale[0], scale[1], scale[2]}};
  const pugi::xml_node submesh = element.child("submesh");
  const std::string part = SdfFile::text_of(submesh.child("name"));
  TENON_TRY(const bool centered, file.flag(submesh, "center", false));
  bool is_guess = false;
  const Result<std::string> path = files_.find(uri, file, is_guess);
  if (!path) {
    const Diagnostic& why = path.error().diagnostic();
    const bool missing = why.rule.empty();
    file.warn(element, missing ? "sdf.mesh-missing" : why.rule.c_str(),
              "the mesh " + (missing ? "\"" + uri + "\" cannot be found" : why.message) +
                  "; the shape is skipped",
              missing ? ModelFiles::advice(uri) : why.fix, Severity::Error);
    return std::optional<Geometry>();
  }
  if (is_guess) {
    file.warn(element, "sdf.mesh-nearby",
              "the mesh \"" + uri + "\" is not at its place; \"" + *path +
                  "\", whose name ends like it, is used",
              ModelFiles::advice(uri), Severity::Info);
  }
  const std::string key = *path + '\n' + part + (centered ? "\n1" : "\n0");
  const auto [at, is_new] = meshes_.emplace(key, static_cast<Index>(model_.meshes.size()));
  if (is_new) {
    robot::MeshFile mesh;
    mesh.written = uri;
    mesh.path = *path;
    mesh.place = file.place_of(element);
    mesh.part = part;
    mesh.centered = centered;
    model_.meshes.push_back(std::move(mesh));
  }
  geometry.mesh = at->second;
  return std::optional(geometry);
}

Result<std::optional<Geometry>> ShapeReader::read_polyline(SdfFile& file, pugi::xml_node outer) {
  Geometry geometry;
  geometry.kind = GeometryKind::Mesh;
  robot::MeshFile mesh;
  for (const pugi::xml_node element : outer.children("polyline")) {
    file.list_skipped(element, {"point", "height"}, {});
    TENON_TRY(const double height, file.number(element, "height", 1));
    std::vector<Vec2d> points;
    for (const pugi::xml_node point : element.children("point")) {
      TENON_TRY(const std::vector<double> xy, file.pair_in(point));
      points.push_back({{xy[0], xy[1]}});
    }
    if (outer.child("polyline") != outer.last_child() && element.next_sibling("polyline")) {
      file.warn(element, "sdf.shape", "is one of several, which may cut holes; each is solid", "");
    }
    if (!add_extruded(points, height, mesh)) {
      file.warn(element, "sdf.shape",
                "is no polygon of at most " + std::to_string(kExtrudedPoints) +
                    " points that does not cross itself; it is skipped",
                "give the corners in their order", Severity::Error);
    }
  }
  if (mesh.triangles.empty()) {
    return std::optional<Geometry>();
  }
  mesh.written = "polyline";
  mesh.place = file.place_of(outer);
  geometry.mesh = static_cast<Index>(model_.meshes.size());
  model_.meshes.push_back(std::move(mesh));
  return std::optional(geometry);
}

}  // namespace tenon::sdf
