// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tenon/describe/scene_reader.h"
#include "tenon/math/color.h"
#include "tenon/stage/material_binding.h"

namespace tenon::describe {

using robot::GeometryKind;
using robot::Index;

namespace {

bool is_unseen(const stage::Prim& prim) {
  const auto purpose = prim.attribute("purpose").get_as<Token>();
  const auto visibility = prim.attribute("visibility").get_as<Token>();
  return (purpose && (*purpose == "guide" || *purpose == "proxy")) ||
         (visibility && *visibility == "invisible");
}

double number(const stage::Prim& prim, const char* name) {
  return prim.attribute(Token(name)).get_as<double>().value_or(0);
}

/// Corners of the triangles of faces, fanned; false where a face names no corner.
bool triangulate(const layer::Array<int>& counts, const layer::Array<int>& indices,
                 std::size_t point_count, bool turned, std::vector<Vec3i>& triangles) {
  std::size_t start = 0;
  for (const int count : counts) {
    if (count < 0 || static_cast<std::size_t>(count) > indices.size() - start) {
      return false;
    }
    const int* face = indices.data() + start;
    for (int k = 0; k < count; ++k) {
      if (face[k] < 0 || static_cast<std::size_t>(face[k]) >= point_count) {
        return false;
      }
    }
    for (int k = 2; k < count; ++k) {
      triangles.push_back(turned ? Vec3i{{face[0], face[k], face[k - 1]}}
                                 : Vec3i{{face[0], face[k - 1], face[k]}});
    }
    start += static_cast<std::size_t>(count);
  }
  return true;
}

/// The identity but for rounding: points stay as they are, to their last bit.
bool is_identity(const Mat4d& m) {
  const Mat4d one = Mat4d::identity();
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      if (std::fabs(m[i][j] - one[i][j]) > 1e-12) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

/// All prims that are there, depth first, children in order.
void SceneReader::walk() {
  std::vector<Place> pending{{stage_.pseudo_root(), std::nullopt, true}};
  while (!pending.empty()) {
    Place place = pending.back();
    pending.pop_back();
    if (!place.prim.is_pseudo_root() &&
        (!place.prim.is_active() || !place.prim.is_defined() || place.prim.is_abstract())) {
      continue;
    }
    enter(place);
    const std::vector<stage::Prim> children = place.prim.children();
    for (auto child = children.rbegin(); child != children.rend(); ++child) {
      pending.push_back({*child, place.link, place.seen});
    }
  }
}

void SceneReader::enter(Place& place) {
  if (const auto at = links_.find(place.prim.path()); at != links_.end()) {
    place.link = at->second;
  } else if (!is_mjcf() && place.prim.has_api("IsaacSiteAPI")) {
    add_site(place);
  }
  place.seen = place.seen && (place.prim.is_pseudo_root() || !is_unseen(place.prim));
  if (place.seen && place.prim.is_a("Gprim")) {
    add_visual(place.prim, place.link ? place.link : world_);
  }
}

/// A named frame is a link without mass. Nothing holds one that stands outside of the robot.
void SceneReader::add_site(Place& place) {
  const std::optional<Index> parent = place.link ? place.link : world_;
  if (!parent) {
    left_out(place.prim.path(), "the frame belongs to no link");
    return;
  }
  const Index site = add_link(place.prim.path(), placed(place.prim).pose);
  in_body_[site] = in_body_[*parent] * inverse(poses_[*parent]) * poses_[site];
  add_fixed(*parent, site, robot::JointKind::Fixed);
  place.link = site;
}

void SceneReader::add_visual(const stage::Prim& prim, std::optional<Index> link) {
  if (!link) {
    left_out(prim.path(), "the shape stands still and belongs to no link");
    return;
  }
  robot::Visual visual;
  std::set<std::string> none;
  visual.name = unique(none, prim.path(), "visual");
  const bool known =
      prim.is_a("Mesh") ? take_mesh(prim, *link, visual) : take_gprim(prim, *link, visual);
  if (!known) {
    left_out(prim.path(), "the shape is empty, skewed or of another kind");
    return;
  }
  for (const stage::Prim& child : prim.children()) {
    if (child.is_a("GeomSubset") && !stage::bound_material(child, Token()).empty()) {
      left_out(child.path(), "some faces have a material of their own");
    }
  }
  visual.material = material_of(prim);
  robot_.links[*link].visuals.push_back(std::move(visual));
}

bool SceneReader::take_mesh(const stage::Prim& prim, Index link, robot::Visual& visual) {
  const auto points = prim.attribute("points").get_as<layer::Array<Vec3f>>();
  const auto counts = prim.attribute("faceVertexCounts").get_as<layer::Array<int>>();
  const auto indices = prim.attribute("faceVertexIndices").get_as<layer::Array<int>>();
  if (!points || !counts || !indices || points->size() == 0) {
    return false;
  }
  robot::MeshFile file;
  const auto [pose, rest] = placed(prim);
  const bool exact = is_identity(rest);
  for (const Vec3f& point : *points) {
    file.points.push_back(exact ? point : to_float(transform_point(to_double(point), rest)));
  }
  const bool left = prim.attribute("orientation").get_as<Token>() == Token("leftHanded");
  const bool turned = left != (determinant(upper_left(rest)) < 0);
  if (!triangulate(*counts, *indices, points->size(), turned, file.triangles)) {
    return false;
  }
  if (is_mjcf()) {
    take_texture_coordinates(prim, turned, file);
  }
  visual.pose = inverse(poses_[link]) * pose;
  visual.geometry.kind = GeometryKind::Mesh;
  visual.geometry.mesh = static_cast<Index>(robot_.meshes.size());
  robot_.meshes.push_back(std::move(file));
  return true;
}

/// Of the corners of the triangles, as they were fanned.
void SceneReader::take_texture_coordinates(const stage::Prim& prim, bool turned,
                                           robot::MeshFile& file) {
  const auto st = prim.attribute("primvars:st").get_as<layer::Array<Vec2f>>();
  const auto counts = prim.attribute("faceVertexCounts").get_as<layer::Array<int>>();
  const auto points = prim.attribute("faceVertexIndices").get_as<layer::Array<int>>();
  if (!st) {
    return;
  }
  const auto indices = prim.attribute("primvars:st:indices").get_as<layer::Array<int>>();
  const Token kind =
      prim.attribute("primvars:st").metadata("interpolation").get_or<Token>(Token("constant"));
  const bool by_point = kind == "vertex" || kind == "varying";
  if (!by_point && !(kind == "faceVarying")) {
    left_out(prim.path(), "texture coordinates are neither of points nor of corners");
    return;
  }
  std::vector<Vec2f> places;
  const auto add = [&](std::size_t corner) {
    auto at = by_point ? static_cast<std::size_t>((*points)[corner]) : corner;
    if (indices) {
      at = at < indices->size() && (*indices)[at] >= 0 ? static_cast<std::size_t>((*indices)[at])
                                                       : st->size();
    }
    places.push_back(at < st->size() ? (*st)[at] : Vec2f{});
  };
  std::size_t start = 0;
  for (const int count : *counts) {
    for (std::size_t k = 2; k < static_cast<std::size_t>(count); ++k) {
      add(start);
      add(start + (turned ? k : k - 1));
      add(start + (turned ? k - 1 : k));
    }
    start += static_cast<std::size_t>(count);
  }
  file.texture_coordinates = std::move(places);
}

/// One without width or length has no end.
void SceneReader::take_plane(const stage::Prim& prim, const Vec3d& scale, robot::Visual& visual) {
  const Token axis = prim.attribute("axis").get_as<Token>().value_or(Token("Z"));
  visual.geometry.kind = GeometryKind::Plane;
  const bool ends =
      prim.attribute("width").has_authored_value() && prim.attribute("length").has_authored_value();
  if (ends && axis == "Z") {
    visual.geometry.half_extents = {{std::fabs(scale[0]) * number(prim, "width") / 2,
                                     std::fabs(scale[1]) * number(prim, "length") / 2, 0}};
  }
  visual.pose = visual.pose * Pose{{},
                                   turn_from_z(axis == "X"   ? scene::Axis::X
                                               : axis == "Y" ? scene::Axis::Y
                                                             : scene::Axis::Z)};
}

bool SceneReader::take_gprim(const stage::Prim& prim, Index link, robot::Visual& visual) {
  const auto [pose, rest] = placed(prim);
  const Vec3d scale = row_scale(rest);
  visual.pose = inverse(poses_[link]) * pose;
  robot::Geometry& g = visual.geometry;
  if (prim.is_a("Cube")) {
    g.kind = GeometryKind::Box;
    for (std::size_t i = 0; i < 3; ++i) {
      g.half_extents[i] = std::fabs(scale[i]) * number(prim, "size") / 2;
    }
    return true;
  }
  if (is_mjcf() && prim.is_a("Plane")) {
    take_plane(prim, scale, visual);
    return true;
  }
  if (is_mjcf() && prim.is_a("Sphere")) {
    g.kind = GeometryKind::Ellipsoid;
    for (std::size_t i = 0; i < 3; ++i) {
      g.half_extents[i] = std::fabs(scale[i]) * number(prim, "radius");
    }
    return true;
  }
  const double size = std::fabs(scale[0]);
  if (std::fabs(std::fabs(scale[1]) - size) > 1e-9 * size ||
      std::fabs(std::fabs(scale[2]) - size) > 1e-9 * size) {
    return false;
  }
  g.radius = size * number(prim, "radius");
  g.half_height = size * number(prim, "height") / 2;
  if (prim.is_a("Sphere")) {
    g.kind = GeometryKind::Sphere;
    return true;
  }
  if (!prim.is_a("Cylinder") && !prim.is_a("Capsule")) {
    return false;
  }
  const Token axis = prim.attribute("axis").get_as<Token>().value_or(Token("Z"));
  g.kind = prim.is_a("Cylinder") ? GeometryKind::Cylinder : GeometryKind::Capsule;
  visual.pose = visual.pose * Pose{{},
                                   turn_from_z(axis == "X"   ? scene::Axis::X
                                               : axis == "Y" ? scene::Axis::Y
                                                             : scene::Axis::Z)};
  return true;
}

std::optional<Index> SceneReader::material_of(const stage::Prim& prim) {
  const Path path = stage::bound_material(prim, Token());
  if (path.empty()) {
    return std::nullopt;
  }
  const auto [at, is_new] = materials_.emplace(path, std::nullopt);
  const stage::Prim material = prim.prim_at(path);
  if (!is_new || !material) {
    return at->second;
  }
  if (is_mjcf()) {
    at->second = surface_of(material);
    return at->second;
  }
  const std::size_t said = diagnostics_.size();
  for (const stage::Prim& shader : material.children()) {
    take_color(shader, path, at->second);
  }
  if (!at->second && diagnostics_.size() == said) {
    left_out(path, "the material has no plain colour");
  }
  return at->second;
}

/// Of the first shader that gives a colour.
void SceneReader::take_color(const stage::Prim& shader, Path material,
                             std::optional<Index>& index) {
  const stage::Attribute color = shader.attribute("inputs:diffuseColor");
  if (color.has_authored_connections()) {
    left_out(shader.path(), "the colour comes from a network of shaders");
  }
  const auto value = color.get_as<Vec3f>();
  if (!value || index) {
    return;
  }
  robot::Material look;
  look.name = unique(material_names_, material, "material");
  const auto opacity = shader.attribute("inputs:opacity").get_as<float>();
  look.color = Vec4d{{srgb_of_linear((*value)[0]), srgb_of_linear((*value)[1]),
                      srgb_of_linear((*value)[2]), opacity.value_or(1.0f)}};
  index = static_cast<Index>(robot_.materials.size());
  robot_.materials.push_back(std::move(look));
}

}  // namespace tenon::describe
