// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

/// Internal to this folder.
namespace tenon::glb {

using GltfJson = nlohmann::ordered_json;

/// Numbers of glTF for the types of components.
enum class Component : int { Byte = 5120, Short = 5122, UShort = 5123, UInt = 5125, Float = 5126 };

/// What the elements of an accessor are.
struct Elements {
  Component component = Component::Float;
  const char* type = "VEC3";  ///< "SCALAR", "VEC2", "VEC3", "VEC4"
  std::size_t stride = 12;    ///< bytes from one to the next, a multiple of 4
  bool normalized = false;    ///< integers represent 0 to 1 or -1 to 1
  bool of_vertices = true;    ///< else of animations
  GltfJson least{};           ///< of positions and times
  GltfJson most{};
};

/// The binary part of a GLB with its views and accessors.
class GlbBuffer {
 public:
  explicit GlbBuffer(bool compressed) : compressed_(compressed) {}

  /// Adds an accessor and returns its number.
  int add(const std::string& bytes, const Elements& elements);
  /// The same for corners of triangles, all below `point_count`.
  int add_triangles(const std::vector<std::uint32_t>& corners, std::size_t point_count);
  /// A view of bytes as they are, such as an image; returns its number.
  int add_view(std::string_view bytes);

  bool compressed() const { return compressed_; }
  bool failed() const { return failed_; }  ///< the codec is not there
  const std::string& bytes() const { return bytes_; }
  /// Fills "accessors", "bufferViews" and "buffers".
  void finish(GltfJson& gltf);

 private:
  int put(const std::string& plain, const std::string* encoded, const char* mode,
          std::size_t stride, std::size_t count, int target);

  bool compressed_;
  bool failed_ = false;
  std::string bytes_;
  std::uint64_t plain_size_ = 0;  // of what is compressed, once it is read back
  GltfJson views_ = GltfJson::array();
  GltfJson accessors_ = GltfJson::array();
};

/// Appends the bytes of a number, little-endian.
template <class T>
void append_bytes(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

}  // namespace tenon::glb
