// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "tenon/robot/robot_model.h"
#include "tenon/urdf/mesh_paths.h"
#include "tenon/urdf/xml_reader.h"

/// Internal to this folder.
namespace tenon::urdf {

/// Reports that `file` is used for `what`, which is not at its place.
void report_guess(XmlReader& xml, pugi::xml_node element, const std::string& what,
                  const std::string& file, std::string advice);

/// A mesh file that a description names and that cannot be read.
struct MissingMesh {
  pugi::xml_node element;
  std::string written;  ///< the name in the description
  std::string rule;
  std::string message;
  std::string advice;
};

/// Reports them, after all links: many of one folder in one finding.
void report_missing_meshes(XmlReader& xml, const std::vector<MissingMesh>& meshes);

/// One reading of a description: several walks through the elements below <robot>.
class UrdfReader {
 public:
  UrdfReader(XmlReader& xml, MeshPaths paths) : xml_(xml), paths_(std::move(paths)) {}

  Result<robot::RobotModel> run(pugi::xml_node robot);

 private:
  // links.cpp
  Result<void> read_link(pugi::xml_node element);
  /// None without a mass, which is reported.
  Result<std::optional<robot::Inertial>> read_inertial(pugi::xml_node element);
  Result<void> read_visual(pugi::xml_node element, robot::Link& link);
  Result<void> read_collision(pugi::xml_node element, robot::Link& link);
  /// None for a mesh that cannot be found and for unknown shapes, which is reported.
  Result<std::optional<robot::Geometry>> read_geometry(pugi::xml_node element);
  Result<std::optional<robot::Geometry>> read_mesh(pugi::xml_node owner, pugi::xml_node element);
  robot::Index mesh_number(const std::string& written, pugi::xml_node element);

  // missing_meshes.cpp
  void report_missing_mesh(const std::string& written, pugi::xml_node element);

  // materials.cpp
  void find_material_definitions(pugi::xml_node robot);
  Result<void> read_global_material(pugi::xml_node element);
  Result<std::optional<robot::Index>> read_material_of(pugi::xml_node shape);
  Result<robot::Material> read_material(pugi::xml_node element);
  robot::Index material_number(robot::Material material);

  // joints.cpp
  Result<void> read_joint(pugi::xml_node element);
  Result<robot::Index> link_named(pugi::xml_node joint, const char* end) const;
  Result<void> read_limit(pugi::xml_node element, robot::Joint& joint);
  Result<void> read_dynamics(pugi::xml_node element, robot::Joint& joint);
  Result<void> read_mimics();

  // gazebo.cpp, after links and joints
  void read_gazebo(pugi::xml_node element);

  // sensors.cpp, after what Gazebo says
  void read_sensor(pugi::xml_node element);

  XmlReader& xml_;
  MeshPaths paths_;
  robot::RobotModel model_;
  std::unordered_map<std::string, robot::Index> links_;
  std::unordered_map<std::string, robot::Index> joints_;
  std::unordered_map<std::string, robot::Index> meshes_;
  std::unordered_map<std::string, robot::Index> material_numbers_;  // by all that they say
  std::unordered_map<std::string, robot::Index> first_material_;    // by name
  std::unordered_map<std::string, pugi::xml_node> definitions_;     // in visuals, by name
  std::unordered_set<std::string> colorless_;                       // materials of a bad colour
  std::vector<MissingMesh> missing_meshes_;
  std::unordered_map<std::string, Error> refusals_;  // of meshes, by the written name
  std::size_t rays_ = 0;                             // of laser scanners
  std::vector<pugi::xml_node> joint_elements_;       // (joint_count)
};

}  // namespace tenon::urdf
