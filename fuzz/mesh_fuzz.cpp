// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0

// Input: a mesh file, STL or OBJ. What is read of it is a mesh: its indices are in range.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "tenon/mesh/check_scene.h"
#include "tenon/mesh/read_mesh.h"

namespace {

/// STL and OBJ may hold numbers that are not finite; that is for others to say.
void make_finite(tenon::mesh::MeshScene& scene) {
  for (tenon::mesh::PolygonMesh& mesh : scene.meshes) {
    for (tenon::Vec3f& point : mesh.points) {
      for (float& x : point.v) {
        x = std::isfinite(x) ? x : 0;
      }
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (text.find("mtllib") != std::string_view::npos) {
    return 0;  // files of this machine are no input
  }
  tenon::Diagnostics diagnostics;
  for (auto scene : {tenon::mesh::read_stl(text, "fuzz.stl"),
                     tenon::mesh::read_obj(text, "fuzz.obj", {}, diagnostics)}) {
    if (scene) {
      make_finite(*scene);
      if (!tenon::mesh::check_scene(*scene, "fuzz")) {
        std::abort();
      }
    }
  }
  return 0;
}
