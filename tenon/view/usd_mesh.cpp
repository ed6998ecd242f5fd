// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A mesh of USD has values for the whole, for faces, for points or for corners of faces, perhaps by
// indices of their own. Here each corner asks for its value, and corners that are alike become one
// point. Faces become fans; what names a corner that is not there makes the face nothing.
#include "tenon/view/usd_mesh.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "tenon/stage/collections/material_binding.h"
#include "tenon/view/corner_welder.h"
#include "tenon/view/smooth_normals.h"

namespace tenon::view {
namespace {

constexpr std::uint32_t kOwn = 0xffffffffu;  // faces of no subset
constexpr double kFlat = 0.9995;             // cosine of 2 degrees
constexpr double kMostlyFlat = 0.9;          // of the triangles

/// Values of a primvar as corners ask for them.
template <class T>
class Primvar {
 public:
  Primvar() = default;
  Primvar(const stage::Prim& prim, const std::string& name, const char* otherwise, stage::Time time)
      : values_(
            prim.attribute(Token(name)).get_as<layer::Array<T>>(time).value_or(layer::Array<T>())),
        kind_(
            prim.attribute(Token(name)).metadata("interpolation").get_or<Token>(Token(otherwise))) {
    if (name.starts_with("primvars:")) {
      indices_ = prim.attribute(Token(name + ":indices"))
                     .get_as<layer::Array<int>>(time)
                     .value_or(layer::Array<int>());
    }
  }

  explicit operator bool() const { return values_.size() > 0; }
  bool is_constant() const { return kind_ == "constant"; }

  T at(std::size_t face, std::size_t corner, std::size_t point) const {
    std::size_t i = kind_ == "constant"      ? 0
                    : kind_ == "uniform"     ? face
                    : kind_ == "faceVarying" ? corner
                                             : point;
    if (indices_.size() > 0) {
      const int index = i < indices_.size() ? indices_[i] : -1;
      i = index < 0 ? values_.size() : static_cast<std::size_t>(index);
    }
    return i < values_.size() ? values_[i] : T{};
  }

 private:
  layer::Array<T> values_;
  layer::Array<int> indices_;
  Token kind_;
};

/// The places in images that a mesh has: by its usual names.
Primvar<Vec2f> places_of(const stage::Prim& prim, stage::Time time) {
  for (const char* name : {"primvars:st", "primvars:st0", "primvars:UVMap", "primvars:map1",
                           "primvars:st_0", "primvars:Texture_uv"}) {
    if (Primvar<Vec2f> found(prim, name, "constant", time); found && !found.is_constant()) {
      return found;
    }
  }
  return {};
}

Primvar<Vec3f> normals_of(const stage::Prim& prim, stage::Time time) {
  if (Primvar<Vec3f> found(prim, "primvars:normals", "vertex", time); found) {
    return found;
  }
  return {prim, "normals", "vertex", time};
}

class UsdMeshReader {
 public:
  UsdMeshReader(const stage::Prim& prim, stage::Time time) : prim_(prim), time_(time) {}

  MeshReading run() {
    const auto points = prim_.attribute("points").get_as<layer::Array<Vec3f>>(time_);
    const auto counts = prim_.attribute("faceVertexCounts").get_as<layer::Array<int>>(time_);
    const auto indices = prim_.attribute("faceVertexIndices").get_as<layer::Array<int>>(time_);
    if (!points || !counts || !indices || points->size() == 0 || counts->size() == 0) {
      return {{}, "the mesh has no points or no faces"};
    }
    points_ = *points;
    indices_ = *indices;
    read_values();
    number_places();
    read_subsets(counts->size());
    look_for_flat_faces(*counts);
    walk_faces(*counts, [this](std::size_t face, const std::array<std::size_t, 3>& corners) {
      for (const std::size_t corner : corners) {
        add_corner(face, corner);
      }
    });
    return finish();
  }

 private:
  void read_values() {
    const Token scheme =
        prim_.attribute("subdivisionScheme").get_as<Token>(time_).value_or(Token("catmullClark"));
    normals_ = normals_of(prim_, time_);
    places_ = places_of(prim_, time_);
    colors_ = Primvar<Vec3f>(prim_, "primvars:displayColor", "constant", time_);
    has_colors_ = colors_ && !colors_.is_constant();
    smooth_ = !normals_ && !(scheme == "none") && !places_ && !has_colors_;
    left_ = prim_.attribute("orientation").get_as<Token>(time_) == Token("leftHanded");
    if (const auto holes = prim_.attribute("holeIndices").get_as<layer::Array<int>>(time_)) {
      holes_.assign(holes->begin(), holes->end());
      std::sort(holes_.begin(), holes_.end());
    }
  }

  void read_subsets(std::size_t face_count) {
    part_of_face_.assign(face_count, kOwn);
    for (const stage::Prim& child : prim_.children()) {
      const bool is_there = child.is_active() && child.is_a("GeomSubset");
      if (!is_there || stage::bound_material(child, Token()).empty() ||
          stage::bound_material(child, Token()) == stage::bound_material(prim_, Token())) {
        continue;
      }
      const auto faces = child.attribute("indices").get_as<layer::Array<int>>(time_);
      const auto part = static_cast<std::uint32_t>(subsets_.size());
      subsets_.push_back(child.path());
      for (const int face : faces.value_or(layer::Array<int>())) {
        if (face >= 0 && static_cast<std::size_t>(face) < face_count) {
          part_of_face_[static_cast<std::size_t>(face)] = part;
        }
      }
    }
  }

  /// Points in one place are one, whatever their numbers: many meshes have three for each triangle.
  void number_places() {
    std::map<std::array<float, 3>, std::uint32_t> known;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const bool sound = is_finite(points_[i]);
      place_of_point_.push_back(
          sound ? known.emplace(points_[i].v, static_cast<std::uint32_t>(i)).first->second : 0);
    }
  }

  /// Nearly all triangles have their own normal: they are not reported.
  void look_for_flat_faces(const layer::Array<int>& counts) {
    std::size_t flat = 0;
    std::size_t all = 0;
    walk_faces(counts, [&](std::size_t face, const std::array<std::size_t, 3>& corners) {
      flat += normals_ && is_flat(face, corners) ? 1 : 0;
      ++all;
    });
    flat_ = static_cast<double>(flat) >= kMostlyFlat * static_cast<double>(all);
  }

  bool is_flat(std::size_t face, const std::array<std::size_t, 3>& corners) const {
    const auto point = [&](std::size_t k) {
      return to_double(points_[static_cast<std::size_t>(indices_[corners[k]])]);
    };
    const Vec3d own = normalized(cross(point(1) - point(0), point(2) - point(0)));
    return std::all_of(corners.begin(), corners.end(), [&](std::size_t at) {
      const auto number = static_cast<std::size_t>(indices_[at]);
      const Vec3d normal = to_double(unit_normal(normals_.at(face, at, number)));
      return own == Vec3d{} || dot(own, normal) > kFlat;
    });
  }

  template <class Each>
  void walk_faces(const layer::Array<int>& counts, Each each) {
    std::size_t start = 0;
    for (std::size_t face = 0; face < counts.size(); ++face) {
      const int count = counts[face];
      if (count < 0 || static_cast<std::size_t>(count) > indices_.size() - start) {
        fault_ = "faces of the mesh name more corners than there are";
        return;
      }
      const auto end = start + static_cast<std::size_t>(count);
      if (!is_hole(face) && is_sound(start, end)) {
        for (std::size_t k = start + 2; k < end; ++k) {
          each(face, {start, left_ ? k : k - 1, left_ ? k - 1 : k});
        }
      }
      start = end;
    }
  }

  bool is_hole(std::size_t face) const {
    return std::binary_search(holes_.begin(), holes_.end(), static_cast<int>(face));
  }

  bool is_sound(std::size_t start, std::size_t end) {
    for (std::size_t k = start; k < end; ++k) {
      const int point = indices_[k];
      if (point < 0 || static_cast<std::size_t>(point) >= points_.size() ||
          !is_finite(points_[static_cast<std::size_t>(point)])) {
        fault_ = "faces of the mesh name points that are not there or not finite";
        return false;
      }
    }
    return true;
  }

  void add_corner(std::size_t face, std::size_t at) {
    Corner corner;
    const auto number = static_cast<std::size_t>(indices_[at]);
    corner.point = place_of_point_[number];
    corner.position = points_[number];
    if (normals_ && !flat_) {
      corner.normal = unit_normal(normals_.at(face, at, number));
    }
    if (places_) {
      const Vec2f place = places_.at(face, at, number);
      corner.st = is_finite(place) ? place : Vec2f{};
    }
    if (has_colors_) {
      const Vec3f color = colors_.at(face, at, number);
      corner.color = is_finite(color) ? color : Vec3f{};
    }
    const std::uint32_t part = part_of_face_[face];
    const auto found =
        welders_.try_emplace(part, normals_ && !flat_, static_cast<bool>(places_), has_colors_);
    found.first->second.add(corner);
  }

  static Vec3f unit_normal(const Vec3f& normal) {
    const Vec3d direction = is_finite(normal) ? to_double(normal) : Vec3d{};
    return to_float(normalized(direction, {{0, 0, 1}}));
  }

  MeshReading finish() {
    MeshReading reading;
    reading.fault = fault_;
    for (auto& [part, welder] : welders_) {
      MeshPart& made = reading.parts.emplace_back();
      made.subset = part == kOwn ? Path() : subsets_[part];
      made.mesh = welder.take();
      if (smooth_) {
        make_smooth_normals(made.mesh);
      }
    }
    if (reading.parts.empty() && reading.fault.empty()) {
      reading.fault = "the mesh has no face with three corners";
    }
    return reading;
  }

  const stage::Prim& prim_;
  stage::Time time_;
  layer::Array<Vec3f> points_;
  layer::Array<int> indices_;
  Primvar<Vec3f> normals_;
  Primvar<Vec2f> places_;
  Primvar<Vec3f> colors_;
  bool has_colors_ = false;
  bool smooth_ = false;
  bool flat_ = false;
  bool left_ = false;
  std::vector<int> holes_;
  std::vector<std::uint32_t> place_of_point_;
  std::vector<Path> subsets_;
  std::vector<std::uint32_t> part_of_face_;
  std::map<std::uint32_t, CornerWelder> welders_;
  std::string fault_;
};

}  // namespace

MeshReading read_usd_mesh(const stage::Prim& prim, stage::Time time) {
  return UsdMeshReader(prim, time).run();
}

}  // namespace tenon::view
