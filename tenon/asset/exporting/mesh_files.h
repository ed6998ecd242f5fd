// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

namespace tenon {

/// MJCF whose meshes are files: those that `text` holds as "vertex" (and "face", "texcoord")
/// become OBJ files in `folder`, a name relative to the text, and are added to `files` by name. The
/// hull of one without faces is its faces. Meshes with other arrays stay, and so do those without
/// volume that have no faces.
std::string with_mesh_files(const std::string& text, const std::string& folder,
                            std::map<std::string, std::string>& files);

}  // namespace tenon
