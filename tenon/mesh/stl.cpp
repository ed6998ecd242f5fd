// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Binary STL: 80 bytes of anything, a count, then 50 bytes for each triangle (normal, three points,
// two bytes). Text STL: `solid`, of each triangle `facet normal`, `outer loop`, three `vertex`,
// then `endsolid`; without it the file was cut. A binary file may begin with the word "solid", so
// the size decides first, then whether it has a byte that is 0, which no text has. Normals are what
// the points say; they are not kept.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "tenon/base/limits/limits.h"
#include "tenon/mesh/point_welder.h"
#include "tenon/mesh/read_mesh.h"
#include "tenon/mesh/text_scanner.h"

namespace tenon::mesh {
namespace {

constexpr std::size_t kHeader = 84;
constexpr std::size_t kTriangle = 50;

Error fault(ErrorCode code, const char* rule, const std::string& path, std::string message) {
  return Error(code, std::move(message)).in_file(path).with_rule(rule);
}

std::uint32_t read_uint32(const char* at) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(at);
  return static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8u |
         static_cast<std::uint32_t>(bytes[2]) << 16u | static_cast<std::uint32_t>(bytes[3]) << 24u;
}

Vec3f read_point(const char* at) {
  return {{std::bit_cast<float>(read_uint32(at)), std::bit_cast<float>(read_uint32(at + 4)),
           std::bit_cast<float>(read_uint32(at + 8))}};
}

/// About the first triangle that no engine and no renderer can use, counted from 1.
Error not_finite(const std::string& path, std::size_t triangle, std::size_t further) {
  const std::string more =
      further == 0 ? "" : " (and so have " + std::to_string(further) + " more triangles)";
  return fault(ErrorCode::Corrupt, "mesh.not-finite", path,
               "triangle " + std::to_string(triangle) +
                   " has a coordinate that is not a finite number" + more)
      .with_fix("export the mesh again, or take the triangle out");
}

MeshScene scene_of(PointWelder& welder, std::vector<std::int32_t> corners) {
  MeshScene scene;
  PolygonMesh& mesh = scene.meshes.emplace_back();
  mesh.points = welder.take_points();
  mesh.face_counts.assign(corners.size() / 3, 3);
  mesh.face_points = std::move(corners);
  return scene;
}

Result<MeshScene> read_binary(std::string_view bytes, const std::string& path) {
  const std::size_t count = (bytes.size() - kHeader) / kTriangle;
  PointWelder welder(count * 3);
  std::vector<std::int32_t> corners(count * 3);
  std::size_t first_bad = count;
  std::size_t bad = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const char* triangle = bytes.data() + kHeader + i * kTriangle + 12;
    bool finite = true;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3f point = read_point(triangle + 12 * corner);
      finite = finite && is_finite(point);
      corners[3 * i + corner] = welder.number(point);
    }
    first_bad = finite ? first_bad : std::min(first_bad, i);
    bad += finite ? 0 : 1;
  }
  if (bad > 0) {
    return not_finite(path, first_bad + 1, bad - 1);
  }
  return scene_of(welder, std::move(corners));
}

// The three numbers behind `vertex`, of facet number `facet`.
Result<Vec3f> read_vertex(TextScanner& scanner, std::size_t facet, const std::string& path) {
  Vec3f point;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<float> number = number_of<float>(scanner.word());
    if (!number) {
      return fault(ErrorCode::Parse, "mesh.stl", path, "a vertex needs three numbers")
          .at(scanner.line(), 0);
    }
    point[i] = *number;
  }
  if (!is_finite(point)) {
    return not_finite(path, facet, 0).at(scanner.line(), 0);
  }
  return point;
}

class TextReader {
 public:
  TextReader(std::string_view text, const std::string& path) : scanner_(text), path_(path) {}

  Result<MeshScene> run() {
    while (scanner_.next_line()) {
      TENON_CHECK(read_line(scanner_.word()));
    }
    if (solid_line_ != 0) {
      return refuse("the file ends inside the solid that begins in line " +
                    std::to_string(solid_line_) + ": it has no \"endsolid\"")
          .with_fix("export the mesh again, or copy the whole file");
    }
    if (corners_.empty()) {
      return refuse("the file has no facet");
    }
    return scene_of(welder_, std::move(corners_));
  }

 private:
  Error refuse(std::string message, ErrorCode code = ErrorCode::Parse) const {
    return fault(code, "mesh.stl", path_, std::move(message)).at(scanner_.line(), 0);
  }

  Result<void> read_line(std::string_view word) {
    if (word == "vertex") {
      TENON_TRY(const Vec3f point, read_vertex(scanner_, corners_.size() / 3 + 1, path_));
      if (corners_.size() >= limits::kMeshCorners) {
        return refuse("more corners than a mesh may have", ErrorCode::Limit);
      }
      corners_.push_back(welder_.number(point));
      ++in_facet_;
    } else if (word == "endfacet") {
      if (in_facet_ != 3) {
        return refuse("a facet has " + std::to_string(in_facet_) + " vertices, not 3");
      }
      in_facet_ = 0;
    } else if (word == "solid") {
      solid_line_ = scanner_.line();
    } else if (word == "endsolid" || (word == "end" && scanner_.word() == "solid")) {
      if (in_facet_ != 0) {
        return refuse("the solid ends inside a facet");
      }
      solid_line_ = 0;
    }
    return {};
  }

  TextScanner scanner_;
  const std::string& path_;
  PointWelder welder_{0};
  std::vector<std::int32_t> corners_;
  std::size_t in_facet_ = 0;
  std::uint32_t solid_line_ = 0;  ///< of the solid that is open; 0 for none
};

}  // namespace

Result<MeshScene> read_stl(std::string_view bytes, const std::string& path) {
  const bool has_header = bytes.size() >= kHeader;
  const std::uint64_t count = has_header ? read_uint32(bytes.data() + 80) : 0;
  if (has_header && count * kTriangle == bytes.size() - kHeader && count > 0) {
    if (count > limits::kMeshCorners / 3) {
      return fault(ErrorCode::Limit, "mesh.stl", path,
                   std::to_string(count) + " triangles are more than a mesh may have");
    }
    return read_binary(bytes, path);
  }
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  const bool is_text = bytes.find('\0') == std::string_view::npos;
  if (is_text && start != std::string_view::npos && bytes.substr(start).starts_with("solid")) {
    return TextReader(bytes, path).run();
  }
  return fault(ErrorCode::Corrupt, "mesh.stl", path,
               has_header ? "the file counts " + std::to_string(count) + " triangles, but has " +
                                std::to_string(bytes.size()) + " bytes, not " +
                                std::to_string(kHeader + count * kTriangle)
                          : "the file is too short for an STL")
      .with_fix("export the mesh again");
}

}  // namespace tenon::mesh
