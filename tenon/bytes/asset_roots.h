// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tenon/bytes/file_bytes.h"
#include "tenon/bytes/files.h"

/// The folders that belong to an asset (docs/reading.md).
namespace tenon::bytes {

/// Of an asset of any format at `path`: its folder, that of the file that it leads to where it is
/// a symbolic link; the folder of the package where it is one of the payloads of a structured
/// asset; the ROS package that it lies in.
std::vector<std::string> roots_of_asset(const Files& files, const std::string& path);

/// The ROS package that a folder lies in: the nearest folder at or above it with a package.xml.
std::optional<std::string> ros_package_of(const Files& files, const std::string& folder);
/// Whether the folder has a package.xml of ROS.
bool is_ros_package(const Files& files, const std::string& folder);
/// The text of a folder's package.xml; null where it is missing or larger than kPackageXmlBytes.
std::shared_ptr<const FileBytes> package_xml_of(const Files& files, const std::string& folder);

/// The folder in which robot formats by convention keep `file`, a part of the description at
/// `path`: a folder of meshes, textures or assets beside the description's own folder, or above it
/// by up to kPartsFolderLevels: robot/urdf/arm.urdf uses robot/meshes, assets/hand/reach.xml uses
/// assets/stls/hand. Also such a folder anywhere in the Python package that the description lies in
/// (the folders above it with an __init__.py): pkg/robots/arm/arm.urdf uses
/// pkg/robots/hands/left/meshes. None for files elsewhere. Links are judged by where they lead.
std::optional<std::string> parts_folder(const Files& files, const std::string& path,
                                        const std::string& file);

}  // namespace tenon::bytes
