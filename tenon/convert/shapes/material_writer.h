// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tenon/convert/robot_layer.h"
#include "tenon/mesh/mesh_scene.h"

/// Internal to this folder.
namespace tenon::convert {

/// The materials of a robot and of its mesh files: each is written when the first shape has it.
class MaterialWriter {
 public:
  /// All of it outlives this.
  MaterialWriter(RobotLayer& layer, const robot::RobotModel& model, const ConvertOptions& options);

  /// Takes up how parts of a mesh file look, with the images that lie inside of it. Returns their
  /// numbers behind those of the model's materials (appearance_count).
  std::vector<robot::Index> add(const std::vector<mesh::Appearance>& appearances,
                                InnerImages images);

  /// Lets a shape look like a material of the model or of `add`.
  void bind_look(Path shape, robot::Index material);
  /// Lets a collider have a surface.
  void bind_surface(Path collider, const robot::Surface& surface);

  /// Images inside of mesh files, when everything is written.
  InnerImages take_images() { return std::move(images_); }

 private:
  struct Entry {
    robot::Material look;
    bool linear = false;  ///< its colour is not as displayed
    Path path{};          ///< empty: not yet written
  };

  robot::Index add_appearance(const mesh::Appearance& appearance);
  Path look_path(Entry& entry);
  Path surface_path(const robot::Surface& surface);
  Path scope();
  bool is_usable(const std::string& image, const robot::Material& look);
  robot::Material with_usable_images(robot::Material look);

  RobotLayer& layer_;
  const ConvertOptions& options_;
  Path scope_;  // empty: not yet written
  NameScope names_;
  std::vector<Entry> entries_;                           // those of the model, then of meshes
  std::unordered_map<std::string, robot::Index> known_;  // those of meshes, by all they say
  std::vector<std::pair<robot::Surface, Path>> surfaces_;
  InnerImages images_;
  std::map<std::string, bool> usable_;  // images, by file, once asked about
};

}  // namespace tenon::convert
