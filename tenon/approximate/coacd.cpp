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

#include <dlfcn.h>

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

/// The folder of the program, for an installed library beside it.
std::string program_folder() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&coacd_is_there), &info) == 0) {
    return {};
  }
  const std::string file = info.dli_fname == nullptr ? "" : info.dli_fname;
  return file.substr(0, file.rfind('/') + 1);
}

void* open_library() {
  const char* chosen = std::getenv("TENON_COACD_LIBRARY");
  if (chosen != nullptr) {
    return *chosen == '\0' ? nullptr : dlopen(chosen, RTLD_NOW | RTLD_LOCAL);
  }
  const std::string beside = program_folder() + "../lib/tenon/coacd/lib_coacd.so";
  void* found = dlopen(beside.c_str(), RTLD_NOW | RTLD_LOCAL);
  const std::string built = TENON_COACD_LIBRARY;
  if (found == nullptr && !built.empty()) {
    found = dlopen(built.c_str(), RTLD_NOW | RTLD_LOCAL);
  }
  return found;
}

Library load() {
  Library library;
  void* handle = open_library();
  if (handle == nullptr) {
    return library;
  }
  library.run = reinterpret_cast<Run>(dlsym(handle, "CoACD_run"));
  library.free = reinterpret_cast<Free>(dlsym(handle, "CoACD_freeMeshArray"));
  const auto set_level = reinterpret_cast<SetLogLevel>(dlsym(handle, "CoACD_setLogLevel"));
  if (set_level != nullptr) {
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
/// for that frees what stands in the list.
extern "C" const char* __lsan_default_suppressions() { return "leak:CoACD_run"; }
#endif

bool coacd_is_there() { return library().run != nullptr && library().free != nullptr; }

std::vector<scene::TriangleMesh> coacd_pieces(const scene::TriangleMesh& mesh, int most,
                                              int vertices) {
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
    // The library's own defaults, but for the two limits and the removal of corners beyond them.
    const CoacdMeshes found = library().run(&raw, 0.05, most, 0, 50, 2000, 20, 150, 3, false, true,
                                            true, vertices, false, 0.01, 0, 0, false);
    std::vector<scene::TriangleMesh> pieces = pieces_of(found);
    library().free(found);
    return pieces;
  } catch (...) {
    return {};
  }
}

}  // namespace tenon::approximate
