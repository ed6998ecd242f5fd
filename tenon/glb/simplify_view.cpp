// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Points in one place are merged while a mesh is simplified, whatever their normals: else every
// crease would stay. Normals are then recomputed. Meshes with images or colours keep their points,
// because those say more than their place.
#include "tenon/glb/simplify_view.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "tenon/approximate/mesh_codec.h"
#include "tenon/view/smooth_normals.h"

namespace tenon::glb {
namespace {

using view::ViewMesh;

constexpr std::size_t kFewest = 64;  // triangles that every mesh may keep

/// One point for each place.
ViewMesh welded(const ViewMesh& mesh) {
  ViewMesh result;
  std::map<std::array<float, 3>, std::uint32_t> known;
  for (const std::uint32_t corner : mesh.corners) {
    const auto [at, is_new] =
        known.emplace(mesh.points[corner].v, static_cast<std::uint32_t>(known.size()));
    if (is_new) {
      result.points.push_back(mesh.points[corner]);
    }
    result.corners.push_back(at->second);
  }
  return result;
}

template <class T>
void keep(std::vector<T>& values, const std::vector<std::uint32_t>& kept) {
  if (values.empty()) {
    return;
  }
  std::vector<T> result;
  result.reserve(kept.size());
  for (const std::uint32_t i : kept) {
    result.push_back(values[i]);
  }
  values = std::move(result);
}

/// Drops points that no triangle has.
void compact(ViewMesh& mesh) {
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> number(mesh.points.size(), kNone);
  std::vector<std::uint32_t> kept;
  for (std::uint32_t& corner : mesh.corners) {
    if (number[corner] == kNone) {
      number[corner] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(corner);
    }
    corner = number[corner];
  }
  keep(mesh.points, kept);
  keep(mesh.normals, kept);
  keep(mesh.st, kept);
  keep(mesh.colors, kept);
}

ViewMesh thinner(const ViewMesh& mesh, std::size_t wanted) {
  if (wanted >= mesh.triangle_count()) {
    return mesh;
  }
  const bool plain = mesh.st.empty() && mesh.colors.empty();
  ViewMesh result = plain ? welded(mesh) : mesh;
  const auto corners = approximate::thinned_out(result.corners, result.points, wanted);
  if (!corners || corners->empty()) {
    return mesh;
  }
  result.corners = *corners;
  compact(result);
  if (plain && !mesh.normals.empty()) {
    view::make_smooth_normals(result);
  }
  return result;
}

}  // namespace

std::size_t simplify_view(view::ViewScene& view, std::size_t budget) {
  const std::size_t drawn = view.drawn_triangles();
  if (drawn <= budget) {
    return drawn;
  }
  const double share = static_cast<double>(budget) / static_cast<double>(drawn);
  for (ViewMesh& mesh : view.meshes) {
    const auto wanted =
        static_cast<std::size_t>(static_cast<double>(mesh.triangle_count()) * share);
    mesh = thinner(mesh, std::max(kFewest, wanted));
  }
  return view.drawn_triangles();
}

void simplify_hulls(view::ViewScene& view, std::size_t budget) {
  std::set<view::Index> hulls;
  for (const view::ViewCollider& collider : view.colliders) {
    if (collider.kind == scene::shape_name(scene::ShapeKind::ConvexHull) ||
        collider.kind == view::kSeveralHulls) {
      for (const view::Index shape : collider.shapes) {
        hulls.insert(view.collider_shapes[shape].mesh);
      }
    }
  }
  for (const view::Index hull : hulls) {
    view.meshes[hull] = thinner(view.meshes[hull], std::max(kFewest, budget));
  }
}

}  // namespace tenon::glb
