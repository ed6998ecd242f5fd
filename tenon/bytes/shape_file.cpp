// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/shape_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace tenon::bytes {
namespace {

std::uint64_t int_at(std::string_view bytes, std::size_t at) {
  std::uint64_t value = 0;
  for (std::size_t i = 4; i-- > 0;) {
    value = value << 8u | static_cast<unsigned char>(bytes[at + i]);
  }
  return value;
}

/// Counts before the data that they count, as unsigned numbers of four bytes.
template <std::size_t N>
std::optional<std::array<std::uint64_t, N>> counts_of(std::string_view bytes) {
  if (bytes.size() < 4 * N) {
    return std::nullopt;
  }
  std::array<std::uint64_t, N> counts{};
  for (std::size_t i = 0; i < N; ++i) {
    counts[i] = int_at(bytes, 4 * i);
  }
  return counts;
}

bool is_binary_stl(std::string_view bytes) {
  constexpr std::size_t kTitle = 80;
  constexpr std::size_t kHeader = kTitle + 4;
  return bytes.size() > kHeader && bytes.size() == kHeader + 50 * int_at(bytes, kTitle);
}

/// Rows, columns, and a float for each place.
bool is_height_field(std::string_view bytes) {
  const auto counts = counts_of<2>(bytes);
  return counts && (*counts)[0] > 0 && (*counts)[1] > 0 && (*counts)[0] < bytes.size() &&
         bytes.size() == 8 + 4 * (*counts)[0] * (*counts)[1];
}

/// Vertices, normals, texture coordinates, triangles.
bool is_counted_mesh(std::string_view bytes) {
  const auto counts = counts_of<4>(bytes);
  return counts && (*counts)[0] > 0 &&
         bytes.size() == 16 + 12 * ((*counts)[0] + (*counts)[1] + (*counts)[3]) + 8 * (*counts)[2];
}

/// Vertices, texture coordinates and triangles, then bones, each with its vertices and weights.
bool is_skin(std::string_view bytes) {
  constexpr std::size_t kBone = 40 + 4 * 7;  // name and pose
  const auto counts = counts_of<4>(bytes);
  if (!counts || (*counts)[0] == 0 || (*counts)[3] == 0) {
    return false;
  }
  std::uint64_t at = 16 + 12 * ((*counts)[0] + (*counts)[2]) + 8 * (*counts)[1];
  for (std::uint64_t bone = 0; bone < (*counts)[3]; ++bone) {
    if (at + kBone + 4 > bytes.size()) {
      return false;
    }
    at += kBone;
    at += 4 + 8 * int_at(bytes, static_cast<std::size_t>(at));
  }
  return at == bytes.size();
}

bool is_text_stl(std::string_view bytes) {
  constexpr std::size_t kLookedAt = 4096;
  return bytes.starts_with("solid") &&
         bytes.substr(0, kLookedAt).find("facet") != std::string_view::npos;
}

/// Lines of OBJ begin with words of a short list; one of them is a vertex.
bool is_obj(std::string_view bytes) {
  constexpr std::string_view kWords[] = {"v",  "vt",     "vn",     "vp",     "f",
                                         "l",  "p",      "o",      "g",      "s",
                                         "mg", "mtllib", "usemtl", "usemap", "maplib"};
  bool has_vertex = false;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    std::string_view line = bytes.substr(at, end - at);
    at = end + 1;
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
    if (line.empty() || line[0] == '#') {
      continue;
    }
    const std::string_view word = line.substr(0, line.find_first_of(" \t\r"));
    if (std::find(std::begin(kWords), std::end(kWords), word) == std::end(kWords)) {
      return false;
    }
    has_vertex = has_vertex || word == "v";
  }
  return has_vertex;
}

}  // namespace

bool is_shape_file(std::string_view bytes) {
  return is_binary_stl(bytes) || is_counted_mesh(bytes) || is_skin(bytes) ||
         is_height_field(bytes) || is_text_stl(bytes) || is_obj(bytes);
}

}  // namespace tenon::bytes
