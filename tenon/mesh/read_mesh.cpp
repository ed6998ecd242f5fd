// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mesh/read_mesh.h"

#include "tenon/bytes/file_bytes.h"
#include "tenon/bytes/lfs_pointer.h"
#include "tenon/bytes/read_record.h"
#include "tenon/mesh/check_scene.h"
#include "tenon/mesh/gltf_files.h"

namespace tenon::mesh {
namespace {

/// The ending of a file name in lower case, without the dot.
std::string ending_of(const std::string& path) {
  const std::size_t dot = path.find_last_of("./");
  if (dot == std::string::npos || path[dot] == '/') {
    return "";
  }
  std::string ending = path.substr(dot + 1);
  for (char& c : ending) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return ending;
}

/// Lets the worker read the file; its answer is checked before it is used.
Result<MeshScene> read_elsewhere(const std::string& path, const MeshReading& reading,
                                 Diagnostics& diagnostics) {
  std::vector<std::string> opened;
  auto read = guard::read_guarded<MeshScene>(
      reading.workers, {guard::Reader::Mesh, path, reading.policy.roots()}, diagnostics, &opened);
  for (const std::string& file : opened) {
    bytes::note_read(file);
  }
  TENON_TRY(MeshScene scene, std::move(read));
  TENON_CHECK(check_scene(scene, path));
  return scene;
}

}  // namespace

Result<MeshScene> read_mesh(const std::string& path, const MeshReading& reading,
                            Diagnostics& diagnostics) {
  const std::string ending = ending_of(path);
  const bool by_assimp = ending == "dae" || ending == "gltf" || ending == "glb";
  if (!by_assimp && ending != "stl" && ending != "obj" && ending != "ply") {
    return Error(ErrorCode::Unsupported, "meshes of the kind \"" + ending + "\" are not read")
        .in_file(path)
        .with_rule("mesh.format")
        .with_fix("export the mesh as .stl, .obj, .ply, .dae, .gltf or .glb");
  }
  TENON_TRY(const auto bytes, reading.policy.open(path));
  TENON_CHECK(bytes::check_no_lfs_pointer(bytes->text(), path));
  if (by_assimp) {
    TENON_CHECK(bytes::check_on_disk(reading.policy.files(), path));
    if (ending != "dae") {
      TENON_CHECK(check_gltf_files(bytes->text(), path, reading.policy));
    }
    return read_elsewhere(path, reading, diagnostics);
  }
  if (ending == "ply") {
    return read_ply(bytes->text(), path);
  }
  return ending == "stl" ? read_stl(bytes->text(), path)
                         : read_obj(bytes->text(), path, reading.policy, diagnostics);
}

}  // namespace tenon::mesh
