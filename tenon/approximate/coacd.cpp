// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// CoACD comes as a shared library with a C interface and no header: what follows declares the part
// that is used, as its own Python module does. It is loaded when a mesh asks for it, so that the
// program starts and works without it. The library may throw; this file alone is built with
// exceptions, and lets none out.
#include "tenon/approximate/coacd.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "tenon/base/shared_library.h"

namespace tenon::approximate {
namespace {

struct CoacdMesh {
  double* vertices;
  std::uint64_t vertex_count;
  int* triangles;
  std::uint64_t triangle_count;
};
struct CoacdMeshes {
  CoacdMesh* meshes;
  std::uint64_t count;
};
using Run = CoacdMeshes (*)(const CoacdMesh* mesh, double threshold, int most, int preprocess,
                            int preprocess_resolution, int resolution, int nodes, int iterations,
                            int depth, bool pca, bool merge, bool decimate, int vertices,
                            bool extrude, double extrude_margin, int shape, unsigned seed,
                            bool real_metric);
using Free = void (*)(CoacdMeshes meshes);
using SetLogLevel = void (*)(const char* level);

struct Library {
  Run run = nullptr;
  Free free = nullptr;
};

SharedLibrary open_library() {
  const char* chosen = std::getenv("TENON_COACD_LIBRARY");
  if (chosen != nullptr) {
    return SharedLibrary::open({chosen});
  }
  const std::string here = folder_of_this_code();
  if (here.empty()) {
    return {};
  }
  return SharedLibrary::open({here + "../" TENON_LIBRARY_FOLDER "/tenon/coacd/lib_coacd.so",
                              here + "tenon/coacd/lib_coacd.so"});
}

Library load() {
  Library library;
  const SharedLibrary opened = open_library();
  opened.find("CoACD_run", library.run);
  opened.find("CoACD_freeMeshArray", library.free);
  SetLogLevel set_level = nullptr;
  if (opened.find("CoACD_setLogLevel", set_level)) {
    set_level("off");
  }
  return library;
}

const Library& library() {
  static const Library loaded = load();
  return loaded;
}

/// Points and triangles of one piece; empty where its numbers are not usable.
scene::TriangleMesh piece_of(const CoacdMesh& raw) {
  scene::TriangleMesh piece;
  for (std::uint64_t i = 0; i < raw.vertex_count; ++i) {
    const double* v = raw.vertices + 3 * i;
    if (!std::isfinite(v[0] + v[1] + v[2])) {
      return {};
    }
    piece.points.push_back({{v[0], v[1], v[2]}});
  }
  for (std::uint64_t i = 0; i < raw.triangle_count; ++i) {
    const int* t = raw.triangles + 3 * i;
    for (int k = 0; k < 3; ++k) {
      if (t[k] < 0 || static_cast<std::uint64_t>(t[k]) >= raw.vertex_count) {
        return {};
      }
    }
    piece.triangles.push_back({{t[0], t[1], t[2]}});
  }
  return piece;
}

std::vector<scene::TriangleMesh> pieces_of(const CoacdMeshes& raw) {
  std::vector<scene::TriangleMesh> pieces;
  for (std::uint64_t i = 0; i < raw.count; ++i) {
    scene::TriangleMesh piece = piece_of(raw.meshes[i]);
    if (piece.points.size() >= 4) {
      pieces.push_back(std::move(piece));
    }
  }
  return pieces;
}

}  // namespace

#if defined(__SANITIZE_ADDRESS__)
/// CoACD 1.0.14 never frees the list that it returns, 32 bytes for each piece: its own function
/// for that frees the contents of the list.
extern "C" const char* __lsan_default_suppressions() { return "leak:CoACD_run"; }
#endif

bool coacd_is_there() { return library().run != nullptr && library().free != nullptr; }

std::vector<scene::TriangleMesh> coacd_pieces(const scene::TriangleMesh& mesh,
                                              const scene::Decomposition& how) {
  if (!coacd_is_there()) {
    return {};
  }
  std::vector<double> points;
  std::vector<int> corners;
  for (const Vec3d& p : mesh.points) {
    points.insert(points.end(), p.v.begin(), p.v.end());
  }
  for (const Vec3i& t : mesh.triangles) {
    corners.insert(corners.end(), t.v.begin(), t.v.end());
  }
  const CoacdMesh raw{points.data(), mesh.points.size(), corners.data(), mesh.triangles.size()};
  try {
    // The library's own defaults, except the requested settings and the removal of excess corners.
    const CoacdMeshes found =
        library().run(&raw, how.concavity, how.most, 0, 50, 2000, 20, 150, 3, false, true, true,
                      how.vertices, false, 0.01, 0, 0, false);
    std::vector<scene::TriangleMesh> pieces = pieces_of(found);
    library().free(found);
    return pieces;
  } catch (...) {
    return {};
  }
}

}  // namespace tenon::approximate
