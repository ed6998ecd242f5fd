// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A mesh is read once and its values are shared by all prims that show it: copies of a value share
// their numbers (layer/value.h). Meshes come as triangles with the description, or from files with
// parts, normals, places in images and looks of their own.
#include "tenon/convert/shapes/mesh_table.h"

#include <array>
#include <string>

#include "tenon/mesh/mesh_shape.h"
#include "tenon/mesh/read_mesh.h"

namespace tenon::convert {

using layer::Value;
using robot::Index;

namespace {

Value extent_value(const std::vector<Vec3f>& points) {
  const auto [low, high] = mesh::extent_of(points);
  return Value(std::vector<Vec3f>{low, high});
}

mesh::PolygonMesh polygons_of(const robot::MeshFile& file) {
  mesh::PolygonMesh mesh;
  mesh.points = file.points;
  mesh.face_counts.assign(file.triangles.size(), 3);
  for (const Vec3i& triangle : file.triangles) {
    mesh.face_points.insert(mesh.face_points.end(), triangle.v.begin(), triangle.v.end());
  }
  mesh.texture_coordinates = file.texture_coordinates;
  return mesh;
}

/// `materials` are those of the file's appearances.
MeshValues values_of(mesh::PolygonMesh mesh, const std::vector<Index>& materials) {
  MeshValues values;
  values.name = mesh.name;
  values.extent = extent_value(mesh.points);
  values.normals_interpolation = mesh.normals.empty() ? "uniform" : "faceVarying";
  values.normals = Value(mesh.normals.empty() ? mesh::face_normals(mesh) : std::move(mesh.normals));
  values.points = Value(std::move(mesh.points));
  values.face_counts = Value(std::move(mesh.face_counts));
  values.face_points = Value(std::move(mesh.face_points));
  if (!mesh.texture_coordinates.empty()) {
    values.texture_coordinates = Value(std::move(mesh.texture_coordinates));
  }
  if (mesh.appearance) {
    values.material = materials[*mesh.appearance];
  }
  return values;
}

/// Moves the middle of the box around all of them to the origin.
void center_meshes(std::vector<mesh::PolygonMesh>& meshes) {
  std::vector<Vec3f> corners;
  for (const mesh::PolygonMesh& one : meshes) {
    const std::array<Vec3f, 2> extent = mesh::extent_of(one.points);
    corners.insert(corners.end(), extent.begin(), extent.end());
  }
  const auto [low, high] = mesh::extent_of(corners);
  for (mesh::PolygonMesh& one : meshes) {
    for (Vec3f& point : one.points) {
      for (std::size_t i = 0; i < 3; ++i) {
        point[i] -= (low[i] + high[i]) / 2;
      }
    }
  }
}

}  // namespace

const std::vector<MeshValues>& MeshTable::parts(Index mesh) {
  const auto [at, is_new] = parts_.try_emplace(mesh);
  if (is_new) {
    at->second = read(source_.model.meshes[mesh]);
  }
  return at->second;
}

void MeshTable::choose_part(const robot::MeshFile& file, std::vector<mesh::PolygonMesh>& meshes) {
  if (!file.part.empty()) {
    const std::size_t before = meshes.size();
    std::string names;
    for (const mesh::PolygonMesh& one : meshes) {
      names += (names.empty() ? "\"" : ", \"") + one.name + "\"";
    }
    std::erase_if(meshes, [&](const mesh::PolygonMesh& one) { return one.name != file.part; });
    if (meshes.empty() && before > 0) {
      layer_.report(file.place, Severity::Error, "convert.mesh-part",
                    "the mesh \"" + file.written + "\" has no part \"" + file.part +
                        "\"; the shape is skipped",
                    "name one of its parts: " + names.substr(0, 1000));
    }
  }
  if (file.centered) {
    center_meshes(meshes);
  }
}

std::vector<MeshValues> MeshTable::read(const robot::MeshFile& file) {
  std::vector<MeshValues> parts;
  if (!file.triangles.empty()) {
    parts.push_back(values_of(polygons_of(file), {}));
    return parts;
  }
  if (file.path.empty()) {
    return parts;
  }
  Result<mesh::MeshScene> scene =
      mesh::read_mesh(file.path, {workers_, source_.options.reading}, layer_.diagnostics());
  if (!scene) {
    const Diagnostic& why = scene.error().diagnostic();
    const bool outside = why.rule == bytes::kOutsideRule;
    layer_.report(file.place, Severity::Error,
                  outside ? bytes::kOutsideRule : "convert.mesh-unreadable",
                  "the mesh \"" + file.written +
                      "\" cannot be read and is skipped: " + scene.error().to_string(),
                  why.fix);
    return parts;
  }
  choose_part(file, scene->meshes);
  const std::vector<Index> materials = materials_.add(scene->appearances, std::move(scene->images));
  for (mesh::PolygonMesh& part : scene->meshes) {
    parts.push_back(values_of(std::move(part), materials));
  }
  return parts;
}

void write_mesh(LayerBuilder& builder, Path prim, const MeshValues& mesh) {
  builder.set_value(prim, "Mesh", "extent", mesh.extent);
  builder.set_value(prim, "Mesh", "faceVertexCounts", mesh.face_counts);
  builder.set_value(prim, "Mesh", "faceVertexIndices", mesh.face_points);
  builder.set_value(prim, "Mesh", "normals", mesh.normals);
  builder.set_metadata(prim.property("normals"), "interpolation",
                       Value(Token(mesh.normals_interpolation)));
  builder.set_value(prim, "Mesh", "points", mesh.points);
  if (!mesh.texture_coordinates.empty()) {
    builder.set_attribute(prim, "primvars:st", "texCoord2f[]", mesh.texture_coordinates);
    builder.set_metadata(prim.property("primvars:st"), "interpolation",
                         Value(Token("faceVarying")));
  }
  builder.set_value(prim, "Mesh", "subdivisionScheme", Value(Token("none")));
}

}  // namespace tenon::convert
