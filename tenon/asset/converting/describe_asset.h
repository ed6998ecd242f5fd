// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "tenon/answers/json.h"
#include "tenon/asset/converting/robot_files.h"
#include "tenon/asset/exporting/description_format.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/open_stage.h"

namespace tenon {

struct DescribeOptions {
  OpenOptions open;
  DescriptionFormat format = DescriptionFormat::Mjcf;
  /// The folder for meshes and images, relative to the output. Empty: one named after the output,
  /// and the meshes of MJCF in its text.
  std::string assets;
};

/// An asset as a robot's description, for other programs.
struct AssetDescription {
  NotedFiles made;
  DescriptionFormat format = DescriptionFormat::Mjcf;
  std::size_t links = 0;  ///< bodies in MJCF
  std::size_t joints = 0;
  std::size_t files_beside = 0;  ///< meshes of URDF and SDF, images and meshes of MJCF
};

/// For a file at `output`, with the files beside it that it names. No file is touched. Errors:
/// those of tenon::open and of the exports; Invalid "convert.assets" for a folder that is not below
/// that of the output, or given for a format without files.
Result<AssetDescription> describe_asset(const std::string& path, const DescribeOptions& options,
                                        const std::string& output, Diagnostics& diagnostics);

/// {"output", "bodies", "joints"} of MJCF, {"output", "links", "joints", "meshes"} of URDF and SDF,
/// {"output", "links", "joints"} of SRDF, {"output", "joints"} of Python files.
answers::Json description_json(const AssetDescription& description, const std::string& output);

}  // namespace tenon
