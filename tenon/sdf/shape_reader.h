// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>

#include "tenon/robot/robot_model.h"
#include "tenon/sdf/model_files.h"
#include "tenon/sdf/sdf_file.h"

/// Internal to this folder.
namespace tenon::sdf {

/// The shapes and the looks of visuals and collisions; meshes and materials go to the model, each
/// once.
class ShapeReader {
 public:
  /// Both outlive this.
  ShapeReader(robot::RobotModel& model, ModelFiles& files) : model_(model), files_(files) {}

  /// None for shapes that are not taken over, which is reported. `pose` is that of the shape, which
  /// a plane turns.
  Result<std::optional<robot::Geometry>> read_geometry(SdfFile& file, pugi::xml_node shape,
                                                       Pose& pose);
  /// materials.cpp. None where nothing is said.
  Result<std::optional<robot::Index>> read_material(SdfFile& file, pugi::xml_node visual);

 private:
  Result<std::optional<robot::Geometry>> read_mesh(SdfFile& file, pugi::xml_node element);
  Result<std::optional<robot::Geometry>> read_polyline(SdfFile& file, pugi::xml_node outer);
  Result<void> read_metal(SdfFile& file, pugi::xml_node metal, robot::Material& material);
  std::string image(SdfFile& file, pugi::xml_node element);
  robot::Index material_number(robot::Material material);

  robot::RobotModel& model_;
  ModelFiles& files_;
  std::map<std::string, robot::Index> meshes_;
  std::map<std::string, robot::Index> material_numbers_;
};

/// How a collision touches, from its <surface>.
Result<robot::Surface> read_surface(SdfFile& file, pugi::xml_node element);

}  // namespace tenon::sdf
