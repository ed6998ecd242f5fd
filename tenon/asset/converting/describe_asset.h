// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "tenon/answers/json.h"
#include "tenon/asset/converting/robot_files.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/open_stage.h"

namespace tenon {

enum class DescriptionFormat : std::uint8_t { Mjcf, Urdf };

/// An asset as a robot's description, for other programs.
struct AssetDescription {
  NotedFiles made;
  DescriptionFormat format = DescriptionFormat::Mjcf;
  std::size_t links = 0;  ///< bodies in MJCF
  std::size_t joints = 0;
  std::size_t files_beside = 0;  ///< meshes of URDF, images of MJCF
};

/// For a file at `output`, with the files beside it that it names. No file is touched. Errors:
/// those of tenon::open, export_mjcf and export_urdf.
Result<AssetDescription> describe_asset(const std::string& path, const OpenOptions& open,
                                        DescriptionFormat format, const std::string& output,
                                        Diagnostics& diagnostics);

/// {"output", "bodies", "joints"} of MJCF, {"output", "links", "joints", "meshes"} of URDF.
answers::Json description_json(const AssetDescription& description, const std::string& output);

}  // namespace tenon
