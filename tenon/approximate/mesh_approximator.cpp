// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/approximate/mesh_approximator.h"

#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "tenon/approximate/coacd.h"
#include "tenon/approximate/piece_cache.h"
#include "tenon/approximate/simplify.h"

namespace tenon::approximate {
namespace {

using Pieces = std::vector<scene::TriangleMesh>;

/// Pieces by the content of meshes: in memory for this run, on disk for the next.
struct Decomposer {
  PieceCache cache;
  std::map<std::string, Pieces> known{};

  Pieces pieces(const scene::TriangleMesh& mesh, const scene::Decomposition& how) {
    const std::string key = piece_key(mesh, how);
    const auto [at, is_new] = known.try_emplace(key);
    if (!is_new) {
      return at->second;
    }
    if (std::optional<Pieces> kept = cache.find(key)) {
      at->second = *std::move(kept);
      return at->second;
    }
    at->second = coacd_pieces(mesh, how);
    if (!at->second.empty()) {
      cache.keep(key, at->second);
    }
    return at->second;
  }
};

}  // namespace

LibraryInfo decomposition_library() {
  LibraryInfo info{"coacd", "", coacd_is_there(), ""};
  if (info.available) {
    info.version = "1.0.14";
  } else {
    info.how_to_get =
        "Build tenon with -DTENON_WITH_COACD=ON, or name lib_coacd.so of the wheel `coacd` in "
        "TENON_COACD_LIBRARY.";
  }
  return info;
}

LibraryInfo simplification_library() {
  LibraryInfo info{"meshoptimizer", meshoptimizer_version(), false, ""};
  info.available = !info.version.empty();
  info.how_to_get =
      info.available ? "" : "Install " TENON_MESHOPTIMIZER_SONAME " (libmeshoptimizer2d).";
  return info;
}

scene::MeshTools mesh_tools(const ApproximateOptions& options) {
  scene::MeshTools tools;
  tools.simplify = simplified;
  // The library is loaded by the first mesh that asks: that costs more than most assets do.
  const auto decomposer =
      std::make_shared<Decomposer>(Decomposer{PieceCache(options.cache_folder)});
  tools.decompose = [decomposer](const scene::TriangleMesh& mesh,
                                 const scene::Decomposition& how) -> std::optional<Pieces> {
    if (!coacd_is_there()) {
      return std::nullopt;
    }
    return decomposer->pieces(mesh, how);
  };
  return tools;
}

std::string default_cache_folder() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && *cache == '/') {
    return std::string(cache) + "/tenon/pieces";
  }
  const char* home = std::getenv("HOME");
  return home == nullptr || *home != '/' ? "" : std::string(home) + "/.cache/tenon/pieces";
}

}  // namespace tenon::approximate
