// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Compressed, points are whole numbers on a grid over the mesh, whose step and place the
// node that shows it takes up in its scale and translation; normals are signed bytes, places in
// images shorts where they lie in the image. Else all are floats.
#include <algorithm>
#include <cmath>

#include "tenon/approximate/mesh_codec.h"
#include "tenon/glb/glb_parts.h"

namespace tenon::glb {
namespace {

template <class T>
std::vector<T> reordered(const std::vector<T>& values, const std::vector<std::uint32_t>& number) {
  std::vector<T> result(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    result[number[i]] = values[i];
  }
  return result;
}

/// Points and triangles in an order that compresses well.
view::ViewMesh ordered(view::ViewMesh mesh) {
  if (const auto number = approximate::put_in_order(mesh.corners, mesh.points.size())) {
    mesh.points = reordered(mesh.points, *number);
    mesh.normals = reordered(mesh.normals, *number);
    mesh.st = reordered(mesh.st, *number);
    mesh.colors = reordered(mesh.colors, *number);
  }
  return mesh;
}

struct Bounds {
  Vec3d least{{kInfinity, kInfinity, kInfinity}};
  Vec3d most{{-kInfinity, -kInfinity, -kInfinity}};
};

Bounds bounds_of(const std::vector<Vec3f>& points) {
  Bounds bounds;
  for (const Vec3f& point : points) {
    for (std::size_t k = 0; k < 3; ++k) {
      bounds.least[k] = std::min(bounds.least[k], static_cast<double>(point[k]));
      bounds.most[k] = std::max(bounds.most[k], static_cast<double>(point[k]));
    }
  }
  return bounds;
}

template <std::size_t N>
std::string bytes_of(const std::vector<Vec<float, N>>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Vec<float, N>)};
}

std::int8_t signed_byte(double value) {
  return static_cast<std::int8_t>(std::lround(std::clamp(value, -1.0, 1.0) * 127));
}

std::uint16_t unsigned_short(double value) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0, 1.0) * 65535));
}

}  // namespace

int GlbMeshes::of(const view::ViewShape& shape, int material) {
  const auto [at, is_new] =
      known_.emplace(std::pair(shape.mesh, material), static_cast<int>(meshes_.size()));
  if (is_new) {
    GltfJson primitive = geometry_of(shape.mesh).primitive;
    primitive["material"] = material;
    GltfJson mesh;
    mesh["primitives"] = GltfJson::array();
    mesh["primitives"].push_back(std::move(primitive));
    meshes_.push_back(std::move(mesh));
  }
  return at->second;
}

const GlbMeshes::Geometry& GlbMeshes::geometry_of(Index mesh) {
  const auto found = geometry_.find(mesh);
  if (found != geometry_.end()) {
    return found->second;
  }
  const view::ViewMesh& source = view_.meshes[mesh];
  return geometry_.emplace(mesh, write(buffer_.compressed() ? ordered(source) : source))
      .first->second;
}

GlbMeshes::Geometry GlbMeshes::write(const view::ViewMesh& mesh) {
  Geometry result;
  GltfJson& attributes = result.primitive["attributes"];
  attributes["POSITION"] = write_points(mesh.points, result.grid);
  if (!mesh.normals.empty()) {
    attributes["NORMAL"] = write_normals(mesh.normals);
  }
  if (!mesh.st.empty()) {
    attributes["TEXCOORD_0"] = write_places(mesh.st);
  }
  if (!mesh.colors.empty()) {
    attributes["COLOR_0"] = write_colors(mesh.colors);
  }
  result.primitive["indices"] = buffer_.add_triangles(mesh.corners, mesh.points.size());
  return result;
}

int GlbMeshes::write_points(const std::vector<Vec3f>& points, Grid& grid) {
  const Bounds bounds = bounds_of(points);
  if (!buffer_.compressed()) {
    Elements elements;
    elements.least = numbers_of(bounds.least);
    elements.most = numbers_of(bounds.most);
    return buffer_.add(bytes_of(points), elements);
  }
  grid.offset = bounds.least;
  const Vec3d size = bounds.most - bounds.least;
  const double largest = std::max({size[0], size[1], size[2]});
  grid.step = largest > 0 ? largest / steps_ : 1;
  std::string bytes;
  GltfJson most = GltfJson::array();
  for (const Vec3f& point : points) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double steps = (static_cast<double>(point[k]) - grid.offset[k]) / grid.step;
      append_bytes(bytes, static_cast<std::uint16_t>(std::lround(steps)));
    }
    append_bytes(bytes, std::uint16_t{0});
  }
  for (std::size_t k = 0; k < 3; ++k) {
    most.push_back(std::lround(size[k] / grid.step));
  }
  Elements elements{Component::UShort, "VEC3", 8};
  elements.least = {0, 0, 0};
  elements.most = std::move(most);
  return buffer_.add(bytes, elements);
}

int GlbMeshes::write_normals(const std::vector<Vec3f>& normals) {
  if (!buffer_.compressed()) {
    return buffer_.add(bytes_of(normals), {});
  }
  std::string bytes;
  for (const Vec3f& normal : normals) {
    for (const float part : normal.v) {
      append_bytes(bytes, signed_byte(part));
    }
    append_bytes(bytes, std::int8_t{0});
  }
  return buffer_.add(bytes, {Component::Byte, "VEC3", 4, true});
}

/// glTF counts from the upper left.
int GlbMeshes::write_places(const std::vector<Vec2f>& places) {
  const bool inside = std::all_of(places.begin(), places.end(), [](const Vec2f& st) {
    return st[0] >= 0 && st[0] <= 1 && st[1] >= 0 && st[1] <= 1;
  });
  const bool narrow = buffer_.compressed() && inside;
  std::string bytes;
  for (const Vec2f& st : places) {
    if (narrow) {
      append_bytes(bytes, unsigned_short(st[0]));
      append_bytes(bytes, unsigned_short(1 - static_cast<double>(st[1])));
    } else {
      append_bytes(bytes, st[0]);
      append_bytes(bytes, 1 - st[1]);
    }
  }
  return narrow ? buffer_.add(bytes, {Component::UShort, "VEC2", 4, true})
                : buffer_.add(bytes, {Component::Float, "VEC2", 8});
}

int GlbMeshes::write_colors(const std::vector<Vec3f>& colors) {
  std::string bytes;
  for (const Vec3f& color : colors) {
    for (const float part : color.v) {
      append_bytes(bytes, unsigned_short(part));
    }
    append_bytes(bytes, std::uint16_t{65535});
  }
  return buffer_.add(bytes, {Component::UShort, "VEC4", 8, true});
}

}  // namespace tenon::glb
