// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <vector>

#include "tenon/mjcf/mjcf_source.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// The materials of a model, with those that its geoms turn out to need.
class MaterialTable {
 public:
  /// Reads all materials of the model. Images that cannot be shown are listed as skipped.
  explicit MaterialTable(MjcfSource& source);

  /// How a geom looks, a number in the table; `has_coordinates`: its shape has a place in images
  /// for each point. One without gets mean colours.
  robot::Index of_geom(int geom, bool has_coordinates);

  /// The table, when all geoms have asked. Settings of materials that surfaces do not support are
  /// listed as skipped.
  std::vector<robot::Material> take();

 private:
  /// The same material for shapes that have no place for its images.
  struct Plain {
    robot::Index material = 0;
    std::vector<int> geoms;  // that have it
  };

  robot::Material read_material(int number);
  void read_images(int number, robot::Material& material);
  void add_image(int number, int role, int texture, robot::Material& material);
  robot::Index own_color(int geom);
  robot::Index without_images(int geom, robot::Index material);
  void report_plain();
  void report_settings();

  MjcfSource& source_;
  std::vector<robot::Material> materials_;  // by MuJoCo's number, then others
  std::vector<int> color_texture_;          // (nmat), MuJoCo's number where it is a file, else -1
  std::map<std::array<double, 4>, robot::Index> color_of_;  // materials of plain colours
  std::map<robot::Index, Plain> plain_;                     // by material
};

}  // namespace tenon::mjcf
