// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/approximate/piece_cache.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "tenon/bytes/file_bytes.h"
#include "tenon/bytes/write/file_transaction.h"

namespace tenon::approximate {
namespace {

/// What the pieces depend on beside the mesh: the library and how it is asked.
constexpr const char* kMethod = "coacd 1.0.14; threshold 0.05";

template <class T>
void put(T number, std::string& bytes) {
  char raw[sizeof(T)];
  std::memcpy(raw, &number, sizeof(T));
  bytes.append(raw, sizeof(T));
}

void put_mesh(const scene::TriangleMesh& mesh, std::string& bytes) {
  put<std::uint64_t>(mesh.points.size(), bytes);
  put<std::uint64_t>(mesh.triangles.size(), bytes);
  for (const Vec3d& p : mesh.points) {
    for (const double x : p.v) {
      put(x, bytes);
    }
  }
  for (const Vec3i& t : mesh.triangles) {
    for (const std::int32_t i : t.v) {
      put(i, bytes);
    }
  }
}

/// Reads from the front of `bytes`; all counts are checked against the remaining bytes.
struct Reader {
  std::string_view bytes;
  bool failed = false;

  template <class T>
  T take() {
    T number{};
    if (bytes.size() < sizeof(T)) {
      failed = true;
      return number;
    }
    std::copy_n(bytes.begin(), sizeof(T), reinterpret_cast<char*>(&number));
    bytes.remove_prefix(sizeof(T));
    return number;
  }

  scene::TriangleMesh mesh() {
    scene::TriangleMesh result;
    const auto points = take<std::uint64_t>();
    const auto triangles = take<std::uint64_t>();
    failed = failed || points > bytes.size() / 24 || triangles > bytes.size() / 12;
    for (std::uint64_t i = 0; i < points && !failed; ++i) {
      Vec3d& p = result.points.emplace_back();
      p = {{take<double>(), take<double>(), take<double>()}};
    }
    for (std::uint64_t i = 0; i < triangles && !failed; ++i) {
      Vec3i& t = result.triangles.emplace_back();
      for (std::int32_t& corner : t.v) {
        corner = take<std::int32_t>();
        failed = failed || corner < 0 || static_cast<std::uint64_t>(corner) >= points;
      }
    }
    return result;
  }
};

/// FNV-1a of the key, as a file name; the key itself is stored in the file.
std::string name_of(const std::string& key) {
  std::uint64_t hash = 0xCBF29CE484222325ull;
  for (const char c : key) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ull;
  }
  char name[32];
  std::snprintf(name, sizeof name, "%016llx.pieces", static_cast<unsigned long long>(hash));
  return name;
}

}  // namespace

std::string piece_key(const scene::TriangleMesh& mesh, const scene::Decomposition& how) {
  static_assert(std::endian::native == std::endian::little);
  std::string key = kMethod;
  put<std::int32_t>(how.most, key);
  put<std::int32_t>(how.vertices, key);
  put<double>(how.concavity, key);
  put_mesh(mesh, key);
  return key;
}

std::optional<std::vector<scene::TriangleMesh>> PieceCache::find(const std::string& key) const {
  if (folder_.empty()) {
    return std::nullopt;
  }
  const auto file = bytes::FileBytes::open(folder_ + "/" + name_of(key));
  if (!file) {
    return std::nullopt;
  }
  const std::string_view bytes = (*file)->text();
  if (!bytes.starts_with(key)) {
    return std::nullopt;
  }
  Reader reader{bytes.substr(key.size())};
  std::vector<scene::TriangleMesh> pieces;
  for (auto count = reader.take<std::uint64_t>(); count > 0 && !reader.failed; --count) {
    pieces.push_back(reader.mesh());
  }
  if (reader.failed || !reader.bytes.empty()) {
    return std::nullopt;
  }
  return pieces;
}

void PieceCache::keep(const std::string& key,
                      const std::vector<scene::TriangleMesh>& pieces) const {
  if (folder_.empty()) {
    return;
  }
  std::error_code fault;
  std::filesystem::create_directories(folder_, fault);
  std::string contents = key;
  put<std::uint64_t>(pieces.size(), contents);
  for (const scene::TriangleMesh& piece : pieces) {
    put_mesh(piece, contents);
  }
  // A folder that cannot be written costs time at the next run, nothing else.
  bytes::FileTransaction transaction;
  transaction.put(folder_ + "/" + name_of(key), contents);
  [[maybe_unused]] const auto written = transaction.commit({.in_place = true});  // or a damaged one
}

}  // namespace tenon::approximate
