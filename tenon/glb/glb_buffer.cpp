// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Where contents are compressed, a view names two places: the one in the file, in its extension,
// and the one that it takes in a second buffer that is not in the file, once it is read back.
#include "tenon/glb/glb_buffer.h"

#include <bit>

#include "tenon/approximate/mesh_codec.h"

namespace tenon::glb {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr int kArray = 34962;
constexpr int kElements = 34963;
constexpr const char* kMeshopt = "EXT_meshopt_compression";

void pad(std::string& bytes) { bytes.resize((bytes.size() + 3) / 4 * 4, '\0'); }

}  // namespace

int GlbBuffer::put(const std::string& plain, const std::string* encoded, const char* mode,
                   std::size_t stride, std::size_t count, int target) {
  const std::string& stored = encoded == nullptr ? plain : *encoded;
  const std::size_t at = bytes_.size();
  bytes_ += stored;
  pad(bytes_);
  GltfJson view;
  view["buffer"] = encoded == nullptr ? 0 : 1;
  view["byteOffset"] = encoded == nullptr ? at : plain_size_;
  view["byteLength"] = plain.size();
  if (target == kArray) {
    view["byteStride"] = stride;
  }
  if (target != 0) {
    view["target"] = target;
  }
  if (encoded != nullptr) {
    view["extensions"][kMeshopt] = {
        {"buffer", 0},          {"byteOffset", at}, {"byteLength", stored.size()},
        {"byteStride", stride}, {"mode", mode},     {"count", count}};
    plain_size_ += (plain.size() + 3) / 4 * 4;
  }
  views_.push_back(std::move(view));
  return static_cast<int>(views_.size()) - 1;
}

int GlbBuffer::add(const std::string& bytes, const Elements& elements) {
  std::optional<std::string> encoded;
  if (compressed_) {
    encoded = approximate::encoded_attributes(bytes, elements.stride);
    failed_ = failed_ || !encoded;
  }
  const std::size_t count = bytes.size() / elements.stride;
  const int view = put(bytes, encoded ? &*encoded : nullptr, "ATTRIBUTES", elements.stride, count,
                       elements.of_vertices ? kArray : 0);
  GltfJson accessor = {{"bufferView", view},
                       {"componentType", static_cast<int>(elements.component)},
                       {"count", count},
                       {"type", elements.type}};
  if (elements.normalized) {
    accessor["normalized"] = true;
  }
  if (!elements.least.is_null()) {
    accessor["min"] = elements.least;
    accessor["max"] = elements.most;
  }
  accessors_.push_back(std::move(accessor));
  return static_cast<int>(accessors_.size()) - 1;
}

int GlbBuffer::add_triangles(const std::vector<std::uint32_t>& corners, std::size_t point_count) {
  const bool narrow = point_count < 65535;  // the largest number means something else
  std::string bytes;
  for (const std::uint32_t corner : corners) {
    if (narrow) {
      append_bytes(bytes, static_cast<std::uint16_t>(corner));
    } else {
      append_bytes(bytes, corner);
    }
  }
  std::optional<std::string> encoded;
  if (compressed_) {
    encoded = approximate::encoded_triangles(corners, point_count);
    failed_ = failed_ || !encoded;
  }
  const int view = put(bytes, encoded ? &*encoded : nullptr, "TRIANGLES", narrow ? 2 : 4,
                       corners.size(), kElements);
  const Component component = narrow ? Component::UShort : Component::UInt;
  accessors_.push_back({{"bufferView", view},
                        {"componentType", static_cast<int>(component)},
                        {"count", corners.size()},
                        {"type", "SCALAR"}});
  return static_cast<int>(accessors_.size()) - 1;
}

int GlbBuffer::add_view(std::string_view bytes) {
  return put(std::string(bytes), nullptr, "", 0, 0, 0);
}

void GlbBuffer::finish(GltfJson& gltf) {
  if (!accessors_.empty()) {
    gltf["accessors"] = std::move(accessors_);
  }
  if (views_.empty()) {
    return;
  }
  gltf["bufferViews"] = std::move(views_);
  gltf["buffers"] = GltfJson::array();
  gltf["buffers"].push_back({{"byteLength", bytes_.size()}});
  if (plain_size_ > 0) {
    GltfJson plain = {{"byteLength", plain_size_}};
    plain["extensions"][kMeshopt] = {{"fallback", true}};
    gltf["buffers"].push_back(std::move(plain));
  }
}

}  // namespace tenon::glb
