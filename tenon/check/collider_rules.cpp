// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What colliders are before anything moves: which of them overlap, whether they can be seen,
// whether their meshes have faces that look outward, whether their size is authored. Reports of
// overlaps have a limit, as a heap of bodies in one place has millions of pairs.
#include <algorithm>
#include <array>
#include <cmath>

#include "tenon/check/overlaps/overlaps.h"
#include "tenon/check/subject.h"
#include "tenon/layer/field_values.h"
#include "tenon/scene/shapes/mesh_inertia.h"

namespace tenon::check {
namespace {

using scene::Collider;
using scene::Index;
using scene::ShapeKind;

/// Pairs that are reported one by one, and those that are counted.
constexpr std::size_t kMaxReports = 100;
constexpr std::size_t kMaxCounted = 10000;

/// The first triangle's normal, by the orientation of the mesh, looks away from the first authored
/// one.
bool first_face_is_turned(const stage::Prim& prim, const layer::Array<Vec3f>& points,
                          const layer::Array<Vec3f>& normals,
                          const layer::Array<std::int32_t>& indices) {
  if (indices.size() < 3 || normals.empty()) {
    return false;
  }
  std::array<Vec3d, 3> corner;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int32_t index = indices[i];
    if (index < 0 || static_cast<std::size_t>(index) >= points.size()) {
      return false;
    }
    corner[i] = to_double(points[static_cast<std::size_t>(index)]);
  }
  Vec3d normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
  if (prim.attribute("orientation").get_as<Token>() == Token("leftHanded")) {
    normal = -normal;
  }
  const bool per_point = normals.size() == points.size();
  const auto place = per_point ? static_cast<std::size_t>(indices[0]) : 0;
  const Vec3d authored = to_double(normals[place]);
  return dot(normal, authored) < -0.5 * length(normal) * length(authored);
}

/// Of a closed mesh; below zero where its faces look inward [m^3].
double signed_volume(const scene::TriangleMesh& mesh) {
  const Vec3d origin = mesh.points.empty() ? Vec3d{} : mesh.points.front();
  double volume = 0;
  for (const Vec3i& t : mesh.triangles) {
    const Vec3d a = mesh.points[static_cast<std::size_t>(t[0])] - origin;
    const Vec3d b = mesh.points[static_cast<std::size_t>(t[1])] - origin;
    const Vec3d c = mesh.points[static_cast<std::size_t>(t[2])] - origin;
    volume += dot(a, cross(b, c)) / 6;
  }
  return volume;
}

/// The instance that shares a prim with others, whose findings would be equal without its name.
Path instance_of(stage::Prim prim) {
  if (!prim || !prim.is_instance_proxy()) {
    return {};
  }
  while (!prim.is_instance()) {
    prim = prim.parent();
  }
  return prim.path();
}

}  // namespace

void check_overlap_at_start(const Subject& subject, Reporter& report) {
  const scene::PhysicsScene& scene = subject.scene;
  auto overlaps = below_planes_at_start(scene, kMaxCounted);
  const std::size_t of_planes = overlaps.size();
  const auto others = overlaps_at_start(scene, kMaxCounted - of_planes);
  overlaps.insert(overlaps.end(), others.begin(), others.end());
  const std::size_t found = overlaps.size();
  overlaps.resize(std::min(found, kMaxReports));
  for (std::size_t i = 0; i < overlaps.size(); ++i) {
    const Collider& first = scene.colliders[overlaps[i].first];
    const Collider& second = scene.colliders[overlaps[i].second];
    const stage::Prim prim = subject.stage.prim(first.path);
    Message message = "at the start the collider";
    if (const Path instance = instance_of(prim); !instance.empty()) {
      message += " of the instance " + named(instance, RelatedRole::Prim);
    }
    message += " reaches into " + named(second.path, RelatedRole::Collider);
    if (i + 1 == kMaxReports && found > kMaxReports) {
      message += std::string(found == kMaxCounted ? ", and at least " : ", and ") +
                 std::to_string(found - kMaxReports) + " more pairs overlap";
    }
    message += ": the solver will push them apart violently";
    for (const Collider* collider : {&first, &second}) {
      if (collider->body) {
        message.about(scene.bodies[*collider->body].path, RelatedRole::Body);
      }
    }
    report.at(prim, message,
              i < of_planes ? "move the body to the side of the plane's axis"
                            : "move them apart, or filter all such pairs with `tenon set ASSET "
                              "--filter-overlaps`");
  }
}

// Isaac: what is not to be seen but collides is a guide.
void check_invisible_collider(const Subject& subject, Reporter& report) {
  for (const Collider& collider : subject.scene.colliders) {
    const stage::Prim prim = subject.stage.prim(collider.path);
    bool invisible = false;
    for (stage::Prim at = prim; at && !at.is_pseudo_root(); at = at.parent()) {
      invisible = invisible || at.attribute("visibility").get_as<Token>() == Token("invisible");
    }
    if (invisible &&
        prim.attribute("purpose").get_as<Token>().value_or("default") != Token("guide")) {
      report.at(prim, "the collider is invisible; what collides and is not to be seen is a guide",
                "author purpose = \"guide\" instead");
    }
  }
}

void check_degenerate_mesh(const Subject& subject, Reporter& report) {
  for (const Collider& collider : subject.scene.colliders) {
    const bool hull = collider.shape.kind == ShapeKind::ConvexHull;
    if (!hull && collider.shape.kind != ShapeKind::Mesh) {
      continue;
    }
    const scene::TriangleMesh& mesh = subject.scene.meshes[collider.shape.mesh];
    const auto is_empty = [&](const Vec3i& t) {
      const Vec3d& a = mesh.points[static_cast<std::size_t>(t[0])];
      const Vec3d b = mesh.points[static_cast<std::size_t>(t[1])] - a;
      const Vec3d c = mesh.points[static_cast<std::size_t>(t[2])] - a;
      return length(cross(b, c)) <= 1e-12 * (dot(b, b) + dot(c, c));
    };
    const auto count = static_cast<std::size_t>(
        std::count_if(mesh.triangles.begin(), mesh.triangles.end(), is_empty));
    if (count > 0 && (!hull || count == mesh.triangles.size())) {
      report.at(subject.stage.prim(collider.path),
                std::to_string(count) + " of " + std::to_string(mesh.triangles.size()) +
                    " triangles of the collider have no area",
                "remove faces whose points are collinear");
    }
  }
}

// M-9: a solid has more area that looks away from its middle than toward it.
void check_inside_out(const Subject& subject, Reporter& report) {
  for (const Collider& collider : subject.scene.colliders) {
    if (collider.shape.kind != ShapeKind::Mesh) {
      continue;
    }
    const scene::TriangleMesh& mesh = subject.scene.meshes[collider.shape.mesh];
    if (!mesh.flat && signed_volume(mesh) < 0 && scene::is_closed(mesh)) {
      report.at(subject.stage.prim(collider.path), "faceVertexIndices",
                "all faces of the closed mesh look inward: engines that know a front of triangles, "
                "as PhysX does, let bodies in and not out",
                "turn the faces, or author orientation = \"leftHanded\"");
    }
  }
}

// S-57: the schema's sizes are in the stage's units, whatever those are.
void check_default_size(const Subject& subject, Reporter& report) {
  constexpr std::pair<const char*, const char*> kSizes[] = {{"Cube", "size"},
                                                            {"Sphere", "radius"},
                                                            {"Capsule", "radius"},
                                                            {"Cylinder", "radius"},
                                                            {"Cone", "radius"}};
  for (const Collider& collider : subject.scene.colliders) {
    const stage::Prim prim = subject.stage.prim(collider.path);
    for (const auto& [type, size] : kSizes) {
      if (prim.type_name() == type && !prim.attribute(size).has_authored_value()) {
        report.at(prim,
                  std::string("no ") + size + " is authored; using the schema default of " +
                      digits(prim.attribute(size).get_as<double>().value_or(0)) + " units",
                  std::string("author ") + size);
      }
    }
  }
}

// which side of a mesh is outside follows from the winding alone.
void check_normals(const Subject& subject, Reporter& report) {
  for (const Collider& collider : subject.scene.colliders) {
    const stage::Prim prim = subject.stage.prim(collider.path);
    if (!prim.is_a("Mesh")) {
      continue;
    }
    const auto points = prim.attribute("points").get_as<layer::Array<Vec3f>>();
    const auto normals = prim.attribute("normals").get_as<layer::Array<Vec3f>>();
    const auto indices = prim.attribute("faceVertexIndices").get_as<layer::Array<std::int32_t>>();
    if (points && normals && indices && first_face_is_turned(prim, *points, *normals, *indices)) {
      report.at(prim, "normals",
                "the normals point against the winding of the faces, which alone says where "
                "outside is",
                "turn the faces, or author orientation = \"leftHanded\"");
    }
  }
}

}  // namespace tenon::check
