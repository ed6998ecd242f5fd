// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Requirements on meshes: extents, topology, normals, meshes in the same place, display colours.
// Arrays are read in place. Meshes in one place are found by a hash of their points, rounded as the
// validator rounds them; what instances share is hashed once.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <set>

#include "tenon/check/simready/judges.h"
#include "tenon/check/simready/reading.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/stage/transform_at.h"

namespace tenon::check::simready {
namespace {

using Points = layer::Array<Vec3f>;
using Integers = layer::Array<std::int32_t>;

bool is_mesh_prim(const stage::Prim& prim) { return prim.is_a(Token("Mesh")); }

/// The value at the default time, or at the first sample.
template <class T>
T earliest(const stage::Prim& prim, const char* name) {
  const stage::Attribute attribute = prim.attribute(Token(name));
  const std::vector<double> times = attribute.time_samples();
  const stage::Time time = times.empty() ? stage::Time() : stage::Time(times.front());
  return attribute.get(time).get_or(T{});
}

bool is_static(const stage::Prim& prim, const char* name) {
  return !prim.attribute(Token(name)).is_animated();
}

struct Faces {
  Points points;
  Integers counts;
  Integers indices;
};

Faces faces_of(const stage::Prim& mesh) {
  return {earliest<Points>(mesh, "points"), earliest<Integers>(mesh, "faceVertexCounts"),
          earliest<Integers>(mesh, "faceVertexIndices")};
}

bool is_topology(const Faces& faces) {
  if (faces.points.empty() || faces.counts.empty() || faces.indices.empty()) {
    return false;
  }
  std::uint64_t corners = 0;
  for (const std::int32_t count : faces.counts) {
    if (count < 0) {
      return false;
    }
    corners += static_cast<std::uint64_t>(count);
  }
  const auto points = static_cast<std::int64_t>(faces.points.size());
  return corners == faces.indices.size() &&
         std::all_of(faces.indices.begin(), faces.indices.end(),
                     [&](std::int32_t index) { return index >= 0 && index < points; });
}

/// The normals that count: the primvar where it has a value, else the attribute.
struct Normals {
  std::string interpolation;
  Points values;
  bool indexed = false;
  Integers indices;

  std::size_t count() const { return indexed ? indices.size() : values.size(); }
};

std::string interpolation_of(const stage::Prim& prim, const char* name, const char* fallback) {
  const layer::Value value = prim.attribute(Token(name)).metadata(Token("interpolation"));
  const Token* token = value.get<Token>();
  return token == nullptr || token->empty() ? fallback : token->str();
}

std::optional<Normals> normals_of(const stage::Prim& mesh) {
  for (const bool primvar : {true, false}) {
    const char* name = primvar ? "primvars:normals" : "normals";
    const layer::Value value = mesh.attribute(Token(name)).get(stage::Time());
    const Points points = earliest<Points>(mesh, name);
    if (value.empty() && points.empty()) {
      continue;
    }
    Normals normals;
    normals.interpolation = interpolation_of(mesh, name, primvar ? "constant" : "vertex");
    normals.values = points;
    normals.indexed = primvar && is_authored(mesh, "primvars:normals:indices");
    if (normals.indexed) {
      normals.indices = earliest<Integers>(mesh, "primvars:normals:indices");
    }
    return normals;
  }
  return std::nullopt;
}

std::optional<std::size_t> wanted_count(const Faces& faces, const std::string& interpolation) {
  if (interpolation == "vertex" || interpolation == "varying") {
    return faces.points.size();
  }
  if (interpolation == "uniform") {
    return faces.counts.size();
  }
  if (interpolation == "faceVarying") {
    return faces.indices.size();
  }
  return interpolation == "constant" ? std::optional<std::size_t>(1) : std::nullopt;
}

std::string scheme_of(const stage::Prim& mesh) {
  const std::string scheme = text(mesh, "subdivisionScheme");
  return scheme.empty() ? "catmullClark" : scheme;
}

bool is_finite_point(const Vec3f& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

Vec3d wide(const Vec3f& p) {
  return {{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])}};
}

/// Twice the area of a face times its normal.
Vec3d area_of(const Faces& faces, std::size_t first, std::size_t count) {
  Vec3d sum{};
  const Vec3d origin = wide(faces.points[static_cast<std::size_t>(faces.indices[first])]);
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const Vec3d a = wide(faces.points[static_cast<std::size_t>(faces.indices[first + i])]);
    const Vec3d b = wide(faces.points[static_cast<std::size_t>(faces.indices[first + i + 1])]);
    sum = sum + cross(a - origin, b - origin);
  }
  return sum;
}

/// Normals against windings, summed over all corners; above 0 where they agree.
double agreement(const Faces& faces, const Normals& normals) {
  const bool per_face = normals.interpolation == "uniform";
  const bool per_corner = normals.interpolation == "faceVarying";
  const auto normal_at = [&](std::size_t place) {
    const std::size_t at =
        normals.indexed ? static_cast<std::size_t>(normals.indices[place]) : place;
    return wide(normals.values[at]);
  };
  double sum = 0;
  std::size_t first = 0;
  for (std::size_t face = 0; face < faces.counts.size(); ++face) {
    const auto count = static_cast<std::size_t>(faces.counts[face]);
    if (count >= 3) {
      const Vec3d area = area_of(faces, first, count);
      for (std::size_t i = 0; i < (per_face ? 1 : count); ++i) {
        const std::size_t corner = first + i;
        const std::size_t place = per_face     ? face
                                  : per_corner ? corner
                                               : static_cast<std::size_t>(faces.indices[corner]);
        sum += dot(area, normal_at(place));
      }
    }
    first += count;
  }
  return sum;
}

/// The box of points, widened by half of the largest width.
std::optional<std::pair<Vec3f, Vec3f>> box_of(const stage::Prim& prim, stage::Time time) {
  const Points points = prim.attribute(Token("points")).get(time).get_or(Points{});
  if (points.empty()) {
    return std::nullopt;
  }
  Vec3f low = points[0];
  Vec3f high = points[0];
  for (const Vec3f& p : points) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  }
  if (!is_mesh_prim(prim)) {
    const auto widths = prim.attribute(Token("widths")).get(time).get_or(layer::Array<float>{});
    const float widest = widths.empty() ? 0 : *std::max_element(widths.begin(), widths.end());
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] -= widest / 2;
      high[i] += widest / 2;
    }
  }
  return std::pair(low, high);
}

bool is_same_point(const Vec3f& a, const Vec3f& b) {
  constexpr double kSmallest = 1e-10;
  return length(wide(a) - wide(b)) <= kSmallest || a == b;
}

bool is_right_extent(const stage::Prim& prim, stage::Time time) {
  const auto box = box_of(prim, time);
  const Points extent = prim.attribute(Token("extent")).get(time).get_or(Points{});
  return !box || (extent.size() == 2 && is_same_point(extent[0], box->first) &&
                  is_same_point(extent[1], box->second));
}

/// 128 bits of numbers.
struct Hash {
  std::uint64_t a = 14695981039346656037U;
  std::uint64_t b = 0x9E3779B97F4A7C15U;

  void add(std::int64_t number) {
    const auto bits = static_cast<std::uint64_t>(number);
    a = (a ^ bits) * 1099511628211U;
    a ^= a >> 29U;
    b = (b + bits) * 0xD6E8FEB86659FD93U;
    b ^= b >> 32U;
  }
  auto operator<=>(const Hash&) const = default;
};

std::optional<Hash> shape_hash(const stage::Prim& mesh) {
  for (const char* name : {"points", "faceVertexIndices", "faceVertexCounts"}) {
    if (!is_static(mesh, name)) {
      return std::nullopt;
    }
  }
  const Faces faces = faces_of(mesh);
  if (faces.points.empty() || faces.counts.empty() || faces.indices.empty()) {
    return std::nullopt;
  }
  Hash hash;
  constexpr double kDigits = 1e6;
  for (const Vec3f& p : faces.points) {
    for (std::size_t i = 0; i < 3; ++i) {
      hash.add(std::llrint(std::clamp(static_cast<double>(p[i]) * kDigits, -9e18, 9e18)));
    }
  }
  for (const Integers* list : {&faces.counts, &faces.indices}) {
    hash.add(static_cast<std::int64_t>(list->size()));
    for (const std::int32_t one : *list) {
      hash.add(one);
    }
  }
  return hash;
}

}  // namespace

void judge_vg_mesh_001(const Judged& judged, Report& report) {
  const auto& prims = judged.stage.with_shared;
  if (std::none_of(prims.begin(), prims.end(), is_mesh_prim)) {
    report.at_root(judged, "the asset has no mesh", "primitive shapes alone are not enough");
  }
}

namespace {

/// Types whose extent no validator computes by itself.
bool needs_extent(const stage::Prim& prim) {
  for (const char* type : {"Mesh", "TetMesh", "BasisCurves", "HermiteCurves", "NurbsCurves",
                           "NurbsPatch", "Volume", "ParticleField"}) {
    if (prim.is_a(Token(type))) {
      return true;
    }
  }
  return false;
}

}  // namespace

void judge_vg_002(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (!is_authored(prim, "extent")) {
      if (needs_extent(prim)) {
        report.at(prim, "the shape has no extent", "author the box of its points");
      }
      continue;
    }
    if (!prim.is_a(Token("PointBased"))) {
      continue;
    }
    std::vector<stage::Time> times;
    for (const double time : prim.attribute(Token("points")).time_samples()) {
      times.emplace_back(time);
    }
    if (times.empty()) {
      times.emplace_back();
    }
    const bool right = std::all_of(times.begin(), times.end(), [&](const stage::Time& time) {
      return is_right_extent(prim, time);
    });
    if (!right) {
      report.at(prim, Token("extent"), "the extent is not the box of the points",
                "author that of the points");
    }
  }
}

void judge_vg_008(const Judged& judged, Report& report) {
  stage::TransformCache transforms{stage::Time()};
  std::map<Path, std::optional<Hash>> of_shared;
  std::map<std::pair<Hash, Hash>, stage::Prim> known;
  constexpr double kStep = 1e-4;
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (!is_mesh_prim(prim) || is_invisible(prim)) {
      continue;
    }
    const Path source = prim.is_instance_proxy() ? prim.prim_in_prototype().path() : prim.path();
    auto found = of_shared.find(source);
    if (found == of_shared.end()) {
      found = of_shared.emplace(source, shape_hash(prim)).first;
    }
    if (!found->second) {
      continue;
    }
    Hash place;
    const Mat4d& world = transforms.local_to_world(prim);
    for (const auto& row : world.m) {
      for (const double one : row) {
        place.add(std::llrint(std::clamp(one / kStep, -9e18, 9e18)));
      }
    }
    const auto [first, is_new] = known.emplace(std::pair(*found->second, place), prim);
    if (!is_new) {
      report.at(
          prim,
          "the same mesh is at the same place as " + named(first->second.path(), RelatedRole::Prim),
          "keep one: the mesh that is drawn may collide as well");
    }
  }
}

void judge_vg_014(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (is_mesh_prim(prim) && !is_topology(faces_of(prim))) {
      report.at(prim, "counts, indices and points of the mesh do not fit together",
                "correct the mesh");
    }
  }
}

void judge_vg_027(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (!is_mesh_prim(prim)) {
      continue;
    }
    const bool plain = is_authored(prim, "normals");
    const bool primvar = is_authored(prim, "primvars:normals");
    const bool subdivided = scheme_of(prim) != "none";
    if (plain && primvar) {
      report.at(prim, "normals and primvars:normals are both authored", "keep primvars:normals");
    }
    if (subdivided && (plain || primvar)) {
      report.at(prim, "a mesh that is subdivided has normals",
                "author subdivisionScheme = \"none\", or no normals");
    } else if (!subdivided && !plain && !primvar) {
      report.at(prim, "a mesh that is not subdivided has no normals", "author primvars:normals");
    }
  }
}

void judge_vg_028(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    const auto normals = is_mesh_prim(prim) ? normals_of(prim) : std::nullopt;
    if (!normals) {
      continue;
    }
    if (scheme_of(prim) != "none") {
      report.at(prim, "a mesh that is subdivided has normals",
                "author subdivisionScheme = \"none\", or no normals");
    }
    const auto wanted = wanted_count(faces_of(prim), normals->interpolation);
    if (!wanted || *wanted != normals->count()) {
      report.at(prim,
                "there are " + std::to_string(normals->count()) + " normals of interpolation " +
                    normals->interpolation +
                    (wanted ? ", which takes " + std::to_string(*wanted) : ", which is unknown"),
                "correct the normals");
    }
    if (!std::all_of(normals->values.begin(), normals->values.end(), is_finite_point)) {
      report.at(prim, "a normal is not finite", "correct the normals");
    }
  }
}

void judge_vg_029(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    const auto normals = is_mesh_prim(prim) ? normals_of(prim) : std::nullopt;
    if (!normals) {
      continue;
    }
    bool still = is_static(prim, "orientation");
    for (const char* name : {"points", "faceVertexIndices", "faceVertexCounts"}) {
      still = still && prim.attribute(Token(name)).is_authored() && is_static(prim, name);
    }
    const Faces faces = faces_of(prim);
    const auto wanted = wanted_count(faces, normals->interpolation);
    const auto values = static_cast<std::int64_t>(normals->values.size());
    const bool inside =
        std::all_of(normals->indices.begin(), normals->indices.end(),
                    [&](std::int32_t index) { return index >= 0 && index < values; });
    if (!still || !is_topology(faces) || !wanted || *wanted != normals->count() || !inside) {
      continue;
    }
    const bool constant = normals->interpolation == "constant";
    const bool agree = constant || agreement(faces, *normals) >= 0;
    if (agree != (text(prim, "orientation") != "leftHanded")) {
      report.at(prim, "the normals point into the other side of the faces",
                "turn the faces or the normals, or author the orientation");
    }
  }
}

namespace {

/// The prim that gives a primvar to `prim`: itself, or the nearest above with a constant one.
stage::Prim primvar_owner(const stage::Prim& prim, const std::string& name) {
  if (is_authored(prim, name)) {
    return prim;
  }
  for (stage::Prim at = prim.parent(); at && !at.is_pseudo_root(); at = at.parent()) {
    if (is_authored(at, name) && interpolation_of(at, name.c_str(), "constant") == "constant") {
      return at;
    }
  }
  return {};
}

bool is_unit(float x) { return x >= 0.0F && x <= 1.0F; }

/// The number of elements, of indices where there are some, fits the interpolation.
bool has_fitting_count(const stage::Prim& prim, const stage::Prim& owner, const std::string& name,
                       std::size_t values) {
  const std::string interpolation = interpolation_of(owner, name.c_str(), "constant");
  std::size_t count = values;
  if (is_authored(owner, name + ":indices")) {
    const auto indices = owner.attribute(Token(name + ":indices")).get().get_or(Integers{});
    for (const std::int32_t index : indices) {
      if (index < 0 || static_cast<std::size_t>(index) >= values) {
        return false;
      }
    }
    count = indices.size();
  }
  if (interpolation == "constant") {
    return count == 1;
  }
  const Faces faces = faces_of(prim);
  const bool points_only = interpolation == "vertex" && prim.is_a(Token("PointBased"));
  if (!is_mesh_prim(prim) && !points_only) {
    return true;
  }
  const auto wanted = wanted_count(faces, interpolation);
  return !wanted || *wanted == 0 || *wanted == count;
}

}  // namespace

void judge_disp_001(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (is_rendered(prim) && !primvar_owner(prim, "primvars:displayColor")) {
      report.at(prim, "the shape has no display colour", "author primvars:displayColor");
    }
  }
}

void judge_disp_002(const Judged& judged, Report& report) {
  static const std::string kName = "primvars:displayColor";
  for (const stage::Prim& prim : judged.stage.with_shared) {
    const stage::Prim owner = is_rendered(prim) ? primvar_owner(prim, kName) : stage::Prim();
    if (!owner) {
      continue;
    }
    const layer::Value value = owner.attribute(Token(kName)).get();
    const auto* colors = value.get<Points>();
    const bool good = colors != nullptr &&
                      std::all_of(colors->begin(), colors->end(),
                                  [](const Vec3f& c) {
                                    return is_unit(c[0]) && is_unit(c[1]) && is_unit(c[2]);
                                  }) &&
                      has_fitting_count(prim, owner, kName, colors->size());
    if (!value.empty() && !good) {
      report.at(prim, Token(kName), "the display colours are no colours from 0 to 1 that fit",
                "correct them");
    }
  }
}

void judge_disp_003(const Judged& judged, Report& report) {
  static const std::string kName = "primvars:displayOpacity";
  for (const stage::Prim& prim : judged.stage.with_shared) {
    const stage::Prim owner = is_rendered(prim) ? primvar_owner(prim, kName) : stage::Prim();
    if (!owner) {
      continue;
    }
    const layer::Value value = owner.attribute(Token(kName)).get();
    const auto* values = value.get<layer::Array<float>>();
    const bool good = values != nullptr && std::all_of(values->begin(), values->end(), is_unit) &&
                      has_fitting_count(prim, owner, kName, values->size());
    if (!value.empty() && !good) {
      report.at(prim, Token(kName), "the opacities are no numbers from 0 to 1 that fit",
                "correct them");
    }
  }
}

}  // namespace tenon::check::simready
