// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Wavefront OBJ: v, vt, vn, f and usemtl, and of its material libraries newmtl, Kd, d, Tr, map_Kd.
// Faces keep their corners; one mesh for each material in order of first use. Nothing marks the end
// of a file but the end of its last line: without that a warning says that it may be cut.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "tenon/base/file_finding.h"
#include "tenon/base/limits/limits.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/mesh/read_mesh.h"
#include "tenon/mesh/text_scanner.h"

namespace tenon::mesh {
namespace {

std::string beside(const std::string& path, std::string_view name) {
  return (std::filesystem::path(path).parent_path() / std::string(name)).generic_string();
}

struct Corner {
  std::size_t point = 0;
  std::optional<std::size_t> texture;
  std::optional<std::size_t> normal;
};

/// Faces of one material, with numbers of points of the whole file.
struct Group {
  std::string material;
  PolygonMesh mesh;
  bool all_normals = true;
  bool all_textures = true;
};

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& path, const bytes::ReadPolicy& policy,
            Diagnostics& diagnostics)
      : scanner_(text),
        path_(path),
        policy_(policy),
        diagnostics_(diagnostics),
        last_line_ends_(text.ends_with('\n')) {}

  Result<MeshScene> run() {
    while (scanner_.next_line()) {
      TENON_CHECK(read_line(scanner_.word()));
    }
    return finish();
  }

 private:
  Error fault(ErrorCode code, std::string message) const {
    return Error(code, std::move(message))
        .in_file(path_)
        .at(scanner_.line(), 0)
        .with_rule("mesh.obj");
  }

  Result<void> read_line(std::string_view word) {
    if (word == "v") {
      return read_point();
    }
    if (word == "vn") {
      return read_numbers(normals_, 3);
    }
    if (word == "vt") {
      return read_numbers(textures_, 1);
    }
    if (word == "f") {
      return read_face();
    }
    if (word == "usemtl") {
      use(std::string(scanner_.rest_of_line()));
    } else if (word == "mtllib") {
      read_library(std::string(scanner_.rest_of_line()));
    } else if (word == "l" || word == "p" || word.starts_with("curv") || word == "surf") {
      ++left_out_;
    }
    return {};
  }

  /// A point is needed; normals and texture coordinates are not: see is_usable().
  Result<void> read_point() {
    TENON_CHECK(read_numbers(points_, 3));
    if (!is_finite(points_.back())) {
      return fault(ErrorCode::Corrupt, "a point has a coordinate that is not a finite number")
          .with_rule("mesh.not-finite")
          .with_fix("export the mesh again, or take out the faces that use the point");
    }
    return {};
  }

  template <std::size_t N>
  Result<void> read_numbers(std::vector<Vec<float, N>>& list, std::size_t needed) {
    Vec<float, N> values;
    for (std::size_t i = 0; i < N; ++i) {
      const std::string_view word = scanner_.word();
      const std::optional<float> number = number_of<float>(word);
      if (!number && (i < needed || !word.empty())) {
        return fault(ErrorCode::Parse, "expected a number, found \"" + std::string(word) + "\"");
      }
      values[i] = number.value_or(0);
    }
    if (list.size() >= limits::kMeshCorners) {
      return fault(ErrorCode::Limit, "more points than a mesh may have");
    }
    list.push_back(values);
    return {};
  }

  Result<std::optional<std::size_t>> index(std::string_view text, std::size_t count) const {
    if (text.empty()) {
      return std::optional<std::size_t>();
    }
    const std::optional<std::int64_t> number = number_of<std::int64_t>(text);
    const auto size = static_cast<std::int64_t>(count);
    if (!number || *number == 0 || *number > size || *number < -size) {
      return fault(ErrorCode::Parse, "a face names \"" + std::string(text) + "\" of " +
                                         std::to_string(count) + " so far");
    }
    return std::optional<std::size_t>(
        static_cast<std::size_t>(*number > 0 ? *number - 1 : size + *number));
  }

  Result<Corner> read_corner(std::string_view word) const {
    const std::size_t first = word.find('/');
    const std::size_t second = first == std::string_view::npos ? first : word.find('/', first + 1);
    Corner corner;
    TENON_TRY(const auto point, index(word.substr(0, first), points_.size()));
    if (!point) {
      return fault(ErrorCode::Parse, "a face's corner names no point");
    }
    corner.point = *point;
    if (first != std::string_view::npos) {
      TENON_TRY(corner.texture, index(word.substr(first + 1, second == std::string_view::npos
                                                                 ? std::string_view::npos
                                                                 : second - first - 1),
                                      textures_.size()));
    }
    if (second != std::string_view::npos) {
      TENON_TRY(corner.normal, index(word.substr(second + 1), normals_.size()));
    }
    return corner;
  }

  Result<void> read_face() {
    Group& group = current();
    PolygonMesh& mesh = group.mesh;
    std::int32_t count = 0;
    for (std::string_view word = scanner_.word(); !word.empty(); word = scanner_.word()) {
      TENON_TRY(const Corner corner, read_corner(word));
      if (++corners_ > limits::kMeshCorners) {
        return fault(ErrorCode::Limit, "more corners of faces than a mesh may have");
      }
      mesh.face_points.push_back(static_cast<std::int32_t>(corner.point));
      mesh.texture_coordinates.push_back(corner.texture ? textures_[*corner.texture] : Vec2f{});
      mesh.normals.push_back(corner.normal ? normals_[*corner.normal] : Vec3f{});
      group.all_textures = group.all_textures && corner.texture.has_value() &&
                           is_usable(mesh.texture_coordinates.back(), "texture coordinate",
                                     "its material's faces get none");
      group.all_normals = group.all_normals && corner.normal.has_value() &&
                          is_usable(mesh.normals.back(), "normal",
                                    "its material's faces get those of their planes");
      ++count;
    }
    if (count < 3) {
      return fault(ErrorCode::Parse, "a face has fewer than 3 corners");
    }
    mesh.face_counts.push_back(count);
    return {};
  }

  /// Says what is done without numbers that nothing can be drawn with.
  template <std::size_t N>
  bool is_usable(const Vec<float, N>& values, const char* what, const char* instead) {
    if (is_finite(values)) {
      return true;
    }
    diagnostics_.add(file_finding(
        Severity::Warning, "mesh.not-finite",
        std::string("the face has a ") + what + " that is not a finite number; " + instead, path_,
        scanner_.line(), "export the mesh again"));
    return false;
  }

  void use(std::string material) {
    const auto [at, is_new] = group_of_.emplace(material, groups_.size());
    if (is_new) {
      groups_.push_back({std::move(material), {}, true, true});
    }
    current_ = at->second;
  }

  Group& current() {
    if (groups_.empty()) {
      use("");
    }
    return groups_[current_];
  }

  void read_library(const std::string& name) {
    const std::string file = beside(path_, name);
    const auto bytes = policy_.open(file);
    if (!bytes && bytes.error().diagnostic().rule == bytes::kOutsideRule) {
      Diagnostic outside = bytes.error().diagnostic();
      outside.severity = Severity::Error;
      outside.message = "the material library " + outside.message + "; colours are lost";
      outside.file = path_;
      outside.line = scanner_.line();
      diagnostics_.add(std::move(outside));
      return;
    }
    if (!bytes) {
      diagnostics_.add(
          file_finding(Severity::Warning, "mesh.material-library-missing",
                       "the material library \"" + name + "\" cannot be read; colours are lost",
                       path_, scanner_.line(), "put the file beside the mesh"));
      return;
    }
    TextScanner lines((*bytes)->text());
    while (lines.next_line()) {
      const std::string_view word = lines.word();
      if (word == "newmtl") {
        appearance_of_.emplace(std::string(lines.rest_of_line()), appearances_.size());
        appearances_.emplace_back();
      } else if (!appearances_.empty()) {
        if (!read_appearance(lines, word, file, appearances_.back())) {
          diagnostics_.add(file_finding(Severity::Warning, "mesh.not-finite",
                                        "a colour or an opacity is not a finite number; full "
                                        "ones are taken",
                                        file, lines.line(), "give numbers from 0 to 1"));
        }
      }
    }
  }

  /// False where a number is not finite; 1 is taken then, as where there is none.
  static bool read_appearance(TextScanner& lines, std::string_view word, const std::string& file,
                              Appearance& look) {
    bool finite = true;
    const auto number = [&] {
      const float value = number_of<float>(lines.word()).value_or(1.0f);
      finite = finite && std::isfinite(value);
      return std::isfinite(value) ? value : 1.0f;
    };
    if (word == "Kd") {
      Vec4f color = look.color.value_or(Vec4f{{1, 1, 1, 1}});
      for (std::size_t i = 0; i < 3; ++i) {
        color[i] = number();
      }
      look.color = color;
    } else if (word == "d" || word == "Tr") {
      const float value = number_of<float>(lines.word()).value_or(word == "d" ? 1.0f : 0.0f);
      finite = std::isfinite(value);
      Vec4f color = look.color.value_or(Vec4f{{1, 1, 1, 1}});
      color[3] = !finite ? 1.0f : word == "d" ? value : 1 - value;
      look.color = color;
    } else if (word == "map_Kd") {
      std::string name(lines.rest_of_line());
      if (name.starts_with('-')) {
        name = name.substr(name.find_last_of(" \t") + 1);  // options come first
      }
      look.texture = beside(file, name);
    }
    return finite;
  }

  /// The points that a group uses, in the order of the file.
  void take_points(PolygonMesh& mesh) const {
    if (groups_.size() == 1) {
      mesh.points = points_;
      return;
    }
    std::vector<std::int32_t> used = mesh.face_points;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (const std::int32_t point : used) {
      mesh.points.push_back(points_[static_cast<std::size_t>(point)]);
    }
    for (std::int32_t& point : mesh.face_points) {
      point = static_cast<std::int32_t>(std::lower_bound(used.begin(), used.end(), point) -
                                        used.begin());
    }
  }

  Result<MeshScene> finish() {
    MeshScene scene;
    for (Group& group : groups_) {
      if (group.mesh.face_counts.empty()) {
        continue;
      }
      PolygonMesh& mesh = group.mesh;
      take_points(mesh);
      if (!group.all_normals) {
        mesh.normals.clear();
      }
      if (!group.all_textures) {
        mesh.texture_coordinates.clear();
      }
      if (const auto look = appearance_of_.find(group.material); look != appearance_of_.end()) {
        mesh.appearance = static_cast<std::uint32_t>(scene.appearances.size());
        scene.appearances.push_back(appearances_[look->second]);
        scene.appearances.back().name = group.material;
      }
      scene.meshes.push_back(std::move(mesh));
    }
    if (scene.meshes.empty()) {
      return fault(ErrorCode::Parse, "the file has no faces");
    }
    if (left_out_ > 0) {
      diagnostics_.add(file_finding(
          Severity::Warning, "mesh.left-out",
          std::to_string(left_out_) + " lines, points and curves of the mesh are skipped", path_));
    }
    if (!last_line_ends_) {
      diagnostics_.add(file_finding(
          Severity::Warning, "mesh.may-be-cut",
          "the last line of the mesh has no line end: where the file was cut, faces are missing",
          path_, scanner_.line(), "copy the whole file again, or end the line where it is whole"));
    }
    return scene;
  }

  TextScanner scanner_;
  const std::string& path_;
  const bytes::ReadPolicy& policy_;
  Diagnostics& diagnostics_;
  bool last_line_ends_;
  std::vector<Vec3f> points_;
  std::vector<Vec3f> normals_;
  std::vector<Vec2f> textures_;
  std::vector<Group> groups_;
  std::map<std::string, std::size_t> group_of_;
  std::size_t current_ = 0;
  std::vector<Appearance> appearances_;
  std::map<std::string, std::size_t> appearance_of_;
  std::size_t left_out_ = 0;
  std::size_t corners_ = 0;
};

}  // namespace

Result<MeshScene> read_obj(std::string_view text, const std::string& path,
                           const bytes::ReadPolicy& policy, Diagnostics& diagnostics) {
  return ObjReader(text, path, policy, diagnostics).run();
}

}  // namespace tenon::mesh
