// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The parts of a file are joined to one mesh, so that one prim is one shape that can collide.
// Numbers become those of the stage: they are scaled once, from double to float, and Y up becomes Z
// up, or the other way, by swapping coordinates, which is exact. Colours become displayColor, one
// for all or one for each face; materials and images need prims of their own, which convert makes.
#include "tenon/asset/authoring/mesh_file.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "tenon/asset_policy.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/base/text/text_number.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/math/color.h"
#include "tenon/mesh/mesh_shape.h"
#include "tenon/mesh/read_mesh.h"
#include "tenon/stage/stage_units.h"

namespace tenon {
namespace {

using mesh::MeshScene;
using mesh::PolygonMesh;

constexpr double kLarge = 50;               // [m]: few meshes of robots and scenes are larger
constexpr Vec3f kGrey{{0.5f, 0.5f, 0.5f}};  // of parts without a colour beside others with one

/// From an up axis of a file to that of the stage.
enum class Turn : std::uint8_t { None, YToZ, ZToY };

Vec3f turned(const Vec3f& v, Turn turn) {
  return turn == Turn::None   ? v
         : turn == Turn::YToZ ? Vec3f{{v[0], -v[2], v[1]}}
                              : Vec3f{{v[0], v[2], -v[1]}};
}

bool is_gltf(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".glb" || ending == ".gltf";
}

std::string axis_name(stage::UpAxis axis) {
  return axis == stage::UpAxis::X ? "X" : axis == stage::UpAxis::Y ? "Y" : "Z";
}

Vec3f color_of(const MeshScene& scene, const PolygonMesh& part) {
  if (!part.appearance || !scene.appearances[*part.appearance].color) {
    return kGrey;
  }
  const mesh::Appearance& look = scene.appearances[*part.appearance];
  Vec3f color;
  for (std::size_t i = 0; i < 3; ++i) {
    const float written = (*look.color)[i];
    color[i] = look.linear ? written : static_cast<float>(linear_of_srgb(written));
  }
  return color;
}

/// Joins the parts; numbers stay those of the file.
class Joined {
 public:
  explicit Joined(const MeshScene& scene) : scene_(scene) {
    const auto all = [&](const auto& has) {
      return std::all_of(scene.meshes.begin(), scene.meshes.end(), has);
    };
    has_normals_ = all([](const PolygonMesh& part) { return !part.normals.empty(); });
    has_coordinates_ =
        all([](const PolygonMesh& part) { return !part.texture_coordinates.empty(); });
    has_color_ = !all([&](const PolygonMesh& part) {
      return !part.appearance || !scene.appearances[*part.appearance].color;
    });
  }

  MeshGeometry join() {
    for (const PolygonMesh& part : scene_.meshes) {
      add(part);
    }
    const bool one = std::all_of(made_.colors.begin(), made_.colors.end(),
                                 [&](const Vec3f& color) { return color == made_.colors[0]; });
    if (one && !made_.colors.empty()) {
      made_.colors.resize(1);
    }
    return std::move(made_);
  }

 private:
  void add(const PolygonMesh& part) {
    const auto first = static_cast<std::int32_t>(made_.shape.points.size());
    const auto append = [](auto& to, const auto& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    append(made_.shape.points, part.points);
    append(made_.shape.face_counts, part.face_counts);
    for (const std::int32_t point : part.face_points) {
      made_.shape.face_points.push_back(first + point);
    }
    if (has_normals_) {
      append(made_.shape.normals, part.normals);
    }
    if (has_coordinates_) {
      append(made_.shape.texture_coordinates, part.texture_coordinates);
    }
    if (has_color_) {
      made_.colors.resize(made_.shape.face_counts.size(), color_of(scene_, part));
    }
  }

  const MeshScene& scene_;
  bool has_normals_ = false;
  bool has_coordinates_ = false;
  bool has_color_ = false;
  MeshGeometry made_;
};

Result<Turn> turn_of(const std::string& from, stage::UpAxis to) {
  if (from != "Y" && from != "Z") {
    return Error(ErrorCode::Invalid, "--file-up " + from + " is no up axis")
        .with_rule("edit.bad-argument")
        .with_fix("write Y or Z");
  }
  if (axis_name(to) == from) {
    return Turn::None;
  }
  if (to == stage::UpAxis::X) {
    return Error(ErrorCode::Unsupported, "X is up in the asset")
        .with_rule("edit.bad-argument")
        .with_fix("give the asset another up axis, Y or Z");
  }
  return to == stage::UpAxis::Z ? Turn::YToZ : Turn::ZToY;
}

/// To the units and the up axis of the stage.
void place(MeshGeometry& mesh, double scale, Turn turn) {
  for (Vec3f& point : mesh.shape.points) {
    point = turned(to_float(to_double(point) * scale), turn);
  }
  for (Vec3f& normal : mesh.shape.normals) {
    normal = turned(normal, turn);
  }
}

double largest_side(const std::vector<Vec3f>& points) {
  const auto [low, high] = mesh::extent_of(points);
  double side = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    side = std::max(side, static_cast<double>(high[i]) - static_cast<double>(low[i]));
  }
  return side;
}

Diagnostic about_file(const std::string& file, const char* rule, std::string message,
                      std::string fix) {
  Diagnostic finding;
  finding.severity = Severity::Warning;
  finding.rule = rule;
  finding.file = file;
  finding.message = std::move(message);
  finding.fix = std::move(fix);
  return finding;
}

bool has_images(const MeshScene& scene) {
  return std::any_of(
      scene.appearances.begin(), scene.appearances.end(),
      [](const mesh::Appearance& look) { return !look.texture.empty() || !look.images.empty(); });
}

Result<MeshScene> read(const std::string& file, const OpenOptions& options,
                       Diagnostics& diagnostics) {
  guard::Workers workers;
  const bytes::ReadPolicy policy = policy_for(file, options);
  TENON_TRY(MeshScene scene, mesh::read_mesh(file, {workers, policy}, diagnostics));
  std::erase_if(scene.meshes, [](const PolygonMesh& part) { return part.face_counts.empty(); });
  if (scene.meshes.empty()) {
    return Error(ErrorCode::Invalid, "the file has no faces")
        .in_file(file)
        .with_rule("edit.empty-mesh")
        .with_fix("export the mesh with its faces; clouds of points and lines are no shapes");
  }
  return scene;
}

}  // namespace

Result<std::shared_ptr<const MeshGeometry>> read_mesh_file(const MeshFileRequest& request,
                                                           const stage::Stage& stage,
                                                           const OpenOptions& options,
                                                           Diagnostics& diagnostics) {
  const std::string file = bytes::absolute_file_path(request.file);
  Diagnostics ignored;  // units that cannot be used are found by check
  const stage::StageUnits units = stage::read_stage_units(stage, ignored);
  const std::string up = !request.up_axis.empty() ? request.up_axis
                         : is_gltf(file)          ? "Y"
                                                  : axis_name(units.up_axis);
  TENON_TRY(const Turn turn,
            request.up_axis.empty() && !is_gltf(file) ? Turn::None : turn_of(up, units.up_axis));
  TENON_TRY(const MeshScene scene, read(file, options, diagnostics));
  const double meters = request.meters.value_or(1);
  MeshGeometry mesh = Joined(scene).join();
  const double side = largest_side(mesh.shape.points) * meters;
  place(mesh, meters / units.meters_per_unit, turn);
  mesh.about = std::to_string(mesh.shape.face_counts.size()) + " faces of " + shown_path(file) +
               ", whose unit is " + shortest(meters) + " m and whose up axis " + up;
  if (side > kLarge && !request.meters) {
    diagnostics.add(about_file(
        file, "edit.mesh-size",
        "the mesh is " + shortest(static_cast<float>(side)) + " m long when a unit is a metre",
        "for a file in millimetres add --file-meters 0.001"));
  }
  if (has_images(scene)) {
    diagnostics.add(about_file(file, "edit.mesh-images", "images of the mesh are skipped",
                               "bind a material with them to the prim"));
  }
  return std::make_shared<const MeshGeometry>(std::move(mesh));
}

}  // namespace tenon
