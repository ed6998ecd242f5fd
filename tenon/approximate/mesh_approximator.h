// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/scene/shapes/mesh_tools.h"

/// Convex decomposition and simplification of meshes, by libraries (S-62).
namespace tenon::approximate {

/// A library that does such work.
struct LibraryInfo {
  std::string name;     ///< "coacd"
  std::string version;  ///< empty when it is not available
  bool available = false;
  std::string how_to_get;  ///< one sentence, when it is not available
};
/// CoACD, loaded when first needed.
LibraryInfo decomposition_library();
/// meshoptimizer, the same.
LibraryInfo simplification_library();

struct ApproximateOptions {
  /// Folder that keeps the pieces of meshes by their content; empty: none are kept.
  std::string cache_folder;
};

/// Both tools; each answers nothing where its library is not available.
scene::MeshTools mesh_tools(const ApproximateOptions& options);

/// $XDG_CACHE_HOME/tenon/pieces or ~/.cache/tenon/pieces; empty when neither is known.
std::string default_cache_folder();

}  // namespace tenon::approximate
