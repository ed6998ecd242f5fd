// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/convert/convert_robot.h"
#include "tenon/layer/layer.h"
#include "tenon/open_stage.h"

namespace tenon {

struct ConvertFileOptions {
  convert::ConvertOptions robot;
  std::string name;  ///< of the robot, in the place of the description's; empty: that
  std::map<std::string, std::string> packages;   ///< folders of ROS packages and models by name
  std::map<std::string, std::string> arguments;  ///< of xacro, by name
  std::string model;  ///< which one of an SDF file with several; empty: the only one
  /// Of these files, sandbox, search paths and what may be read count; `robot.reading` is made of
  /// them.
  OpenOptions open;
};

struct ConvertedFile {
  layer::Layer layer;
  convert::InnerImages images;  ///< that asset paths of the layer name, and that are no files
  bytes::ReadPolicy reading;    ///< where its files lie
  std::size_t links = 0;        ///< of the description
  std::size_t joints = 0;
  std::size_t meshes = 0;  ///< files
};

/// A robot's description as a layer (convert/convert_robot.h): URDF, SDF or MJCF, told by its root;
/// macros of xacro are expanded (xacro/expand_xacro.h).
/// Asset paths of the layer are absolute. What the description names is read from the folders that
/// belong to it (docs/reading.md); other files are skipped, with an error. Errors: those of reading
/// and converting; Missing for MJCF without MuJoCo; Unsupported "file.not-on-disk" for MJCF,
/// Collada and glTF that the worker would not find on the disk.
Result<ConvertedFile> convert_file(const std::string& path, const ConvertFileOptions& options,
                                   Diagnostics& diagnostics);

}  // namespace tenon
