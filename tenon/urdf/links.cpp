// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// URDF gives full sizes, the model half sizes. Each mesh name gets its number when it is first met
// and is looked for once. A mesh that is not found keeps its number with an empty path, and each
// shape that uses it is reported and skipped, while the link stays; so is an inertial without mass.
// One without inertia is told with the body that it becomes. A token that is not a number ends the
// reading, except commas between numbers of shapes and inertials.
#include "tenon/urdf/urdf_reader.h"

namespace tenon::urdf {

using robot::Geometry;
using robot::GeometryKind;

void report_guess(XmlReader& xml, pugi::xml_node element, const std::string& what,
                  const std::string& file, std::string advice) {
  xml.warn(element, "urdf.mesh-nearby",
           what + " is not at its place; \"" + file + "\", whose name ends like it, is used",
           std::move(advice), Severity::Info);
}

Result<void> UrdfReader::read_link(pugi::xml_node element) {
  xml_.list_unknown(element, {"name"}, {"inertial", "visual", "collision"});
  robot::Link link;
  TENON_TRY(link.name, xml_.text(element, "name"));
  link.place = xml_.place_of(element);
  if (const pugi::xml_node inertial = element.child("inertial")) {
    TENON_TRY(link.inertial, read_inertial(inertial));
    if (inertial.next_sibling("inertial")) {
      xml_.warn(inertial.next_sibling("inertial"), "urdf.left-out",
                "is the second one of the link; it is skipped", "keep one");
    }
  }
  for (const pugi::xml_node visual : element.children("visual")) {
    TENON_CHECK(read_visual(visual, link));
  }
  for (const pugi::xml_node collision : element.children("collision")) {
    TENON_CHECK(read_collision(collision, link));
  }
  links_.emplace(link.name, static_cast<robot::Index>(model_.links.size()));
  model_.links.push_back(std::move(link));
  return {};
}

Result<std::optional<robot::Inertial>> UrdfReader::read_inertial(pugi::xml_node element) {
  xml_.list_unknown(element, {}, {"origin", "mass", "inertia"});
  robot::Inertial inertial;
  inertial.place = xml_.place_of(element);
  TENON_TRY(const Pose origin, xml_.origin(element));
  inertial.center_of_mass = origin.position;
  inertial.axes = origin.orientation;
  const pugi::xml_node mass = element.child("mass");
  if (!mass) {
    xml_.warn(element, "urdf.missing", "has no <mass>; it is skipped",
              "add <mass value=\"...\"/> [kg]", Severity::Error);
    return std::optional<robot::Inertial>();
  }
  xml_.list_unknown(mass, {"value"}, {});
  TENON_TRY(inertial.mass, xml_.number(mass, "value", std::nullopt));
  const pugi::xml_node inertia = element.child("inertia");
  if (!inertia) {
    return std::optional<robot::Inertial>(inertial);
  }
  xml_.list_unknown(inertia, {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}, {});
  struct Entry {
    const char* name;
    std::size_t row;
    std::size_t column;
  };
  for (const Entry& entry : {Entry{"ixx", 0, 0},
                             {"ixy", 0, 1},
                             {"ixz", 0, 2},
                             {"iyy", 1, 1},
                             {"iyz", 1, 2},
                             {"izz", 2, 2}}) {
    const bool diagonal = entry.row == entry.column;
    TENON_TRY(const double value,
              xml_.number(inertia, entry.name, diagonal ? std::optional<double>() : 0.0));
    inertial.inertia[entry.row][entry.column] = value;
    inertial.inertia[entry.column][entry.row] = value;
  }
  return std::optional<robot::Inertial>(inertial);
}

Result<void> UrdfReader::read_visual(pugi::xml_node element, robot::Link& link) {
  xml_.list_unknown(element, {"name"}, {"origin", "geometry", "material"});
  robot::Visual visual;
  visual.name = element.attribute("name").value();
  visual.place = xml_.place_of(element);
  TENON_TRY(visual.pose, xml_.origin(element));
  TENON_TRY(const std::optional<Geometry> geometry, read_geometry(element));
  TENON_TRY(visual.material, read_material_of(element));
  if (geometry) {
    visual.geometry = *geometry;
    link.visuals.push_back(std::move(visual));
  }
  return {};
}

Result<void> UrdfReader::read_collision(pugi::xml_node element, robot::Link& link) {
  xml_.list_unknown(element, {"name"}, {"origin", "geometry"});
  robot::Collider collider;
  collider.name = element.attribute("name").value();
  collider.place = xml_.place_of(element);
  TENON_TRY(collider.pose, xml_.origin(element));
  TENON_TRY(const std::optional<Geometry> geometry, read_geometry(element));
  if (geometry) {
    collider.geometry = *geometry;
    link.colliders.push_back(std::move(collider));
  }
  return {};
}

Result<std::optional<Geometry>> UrdfReader::read_geometry(pugi::xml_node element) {
  const pugi::xml_node outer = element.child("geometry");
  if (!outer) {
    xml_.warn(element, "urdf.missing", "has no <geometry>; it is skipped", "add one",
              Severity::Error);
    return std::optional<Geometry>();
  }
  xml_.list_unknown(outer, {}, {"box", "sphere", "cylinder", "capsule", "mesh"});
  for (const pugi::xml_node shape : outer.children()) {
    const std::string kind = shape.name();
    Geometry geometry;
    if (kind == "box") {
      xml_.list_unknown(shape, {"size"}, {});
      TENON_TRY(const std::vector<double> size, xml_.numbers_of(element, shape, "size", 3, {}));
      geometry.half_extents = {{size[0] / 2, size[1] / 2, size[2] / 2}};
      return std::optional<Geometry>(geometry);
    }
    if (kind == "sphere") {
      xml_.list_unknown(shape, {"radius"}, {});
      geometry.kind = GeometryKind::Sphere;
      TENON_TRY(geometry.radius, xml_.number(shape, "radius", std::nullopt));
      return std::optional<Geometry>(geometry);
    }
    if (kind == "cylinder" || kind == "capsule") {
      xml_.list_unknown(shape, {"radius", "length"}, {});
      geometry.kind = kind == "cylinder" ? GeometryKind::Cylinder : GeometryKind::Capsule;
      TENON_TRY(geometry.radius, xml_.number(shape, "radius", std::nullopt));
      TENON_TRY(const double length, xml_.number(shape, "length", std::nullopt));
      geometry.half_height = length / 2;
      return std::optional<Geometry>(geometry);
    }
    if (kind == "mesh") {
      return read_mesh(element, shape);
    }
  }
  xml_.warn(outer, "urdf.shape",
            "has no known shape; the " + std::string(element.name()) + " is skipped",
            "give it a box, sphere, cylinder, capsule or mesh", Severity::Error);
  return std::optional<Geometry>();
}

Result<std::optional<Geometry>> UrdfReader::read_mesh(pugi::xml_node owner,
                                                      pugi::xml_node element) {
  xml_.list_unknown(element, {"filename", "scale"}, {});
  Geometry geometry;
  geometry.kind = GeometryKind::Mesh;
  TENON_TRY(const std::string written, xml_.text(element, "filename"));
  TENON_TRY(const std::vector<double> scale,
            xml_.numbers_of(owner, element, "scale", 3, {1, 1, 1}));
  geometry.scale = {{scale[0], scale[1], scale[2]}};
  geometry.mesh = mesh_number(written, element);
  if (model_.meshes[geometry.mesh].path.empty()) {
    report_missing_mesh(written, element);
    return std::optional<Geometry>();
  }
  return std::optional<Geometry>(geometry);
}

robot::Index UrdfReader::mesh_number(const std::string& written, pugi::xml_node element) {
  const auto [at, is_new] =
      meshes_.emplace(written, static_cast<robot::Index>(model_.meshes.size()));
  if (is_new) {
    const Result<std::string> file = paths_.find(written);
    if (!file && !file.error().diagnostic().rule.empty()) {
      refusals_.emplace(written, file.error());
    }
    if (file && paths_.is_guess(written)) {
      report_guess(xml_, element, "the mesh \"" + written + "\"", *file, paths_.advice(written));
    }
    model_.meshes.push_back({written, file.value_or(""), xml_.place_of(element), {}, {}});
  }
  return at->second;
}

}  // namespace tenon::urdf
