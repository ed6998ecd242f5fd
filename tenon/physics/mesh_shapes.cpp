// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "tenon/physics/convex_hull.h"
#include "tenon/physics/shapes.h"
#include "tenon/physics/world_pose.h"

namespace tenon::physics {
namespace {

/// How a mesh is to collide (S-62).
enum class Approximation { None, Hull, Decomposition, Simplification, Ball, Box };

Approximation approximation_of(const ReadState& state, const ShapeSource& source) {
  const PhysicsPrim& found = source.found;
  const bool applied = found.roles.has(Api::MeshCollision) ||
                       found.roles.has(Api::NewtonMeshCollision) ||
                       found.roles.has(Api::MjcMeshCollision);
  const Token name = state.tokens.approximation;
  if (!applied) {
    if (found.prim.attribute(name).has_authored_value()) {
      state.report(found.prim, name, Severity::Warning, "collider.approximation-without-api",
                   "physics:approximation is ignored: PhysicsMeshCollisionAPI is not applied",
                   "apply PhysicsMeshCollisionAPI");
    }
    return Approximation::None;
  }
  const Token token = state.values.get<Token>(found.prim, name).value_or(Token("none"));
  constexpr std::pair<std::string_view, Approximation> kTokens[] = {
      {"none", Approximation::None},
      {"convexHull", Approximation::Hull},
      {"convexDecomposition", Approximation::Decomposition},
      {"meshSimplification", Approximation::Simplification},
      {"boundingSphere", Approximation::Ball},
      {"boundingCube", Approximation::Box}};
  for (const auto& [text, kind] : kTokens) {
    if (token == text) {
      return kind;
    }
  }
  state.report(found.prim, name, Severity::Warning, "collider.approximation-unknown",
               "physics:approximation is \"" + token.str() + "\"; " +
                   (source.dynamic ? "the convex hull" : "the mesh itself") + " is used instead",
               "use none, convexHull, convexDecomposition, meshSimplification, boundingSphere or "
               "boundingCube");
  return source.dynamic ? Approximation::Hull : Approximation::None;
}

/// Points of the mesh in the collider's rigid frame, exact under any matrix [m].
std::vector<Vec3d> placed_points(const ReadState& state, const ShapeSource& source,
                                 const layer::Array<Vec3f>& points) {
  const Mat3d linear = upper_left(source.found.world);
  const Quatd back = conjugate(source.frame.orientation);
  std::vector<Vec3d> placed;
  placed.reserve(points.size());
  for (const Vec3f& p : points) {
    placed.push_back(rotate(back, to_double(p) * linear) * state.units.length);
  }
  return placed;
}

struct Faces {
  layer::Array<std::int32_t> counts;
  layer::Array<std::int32_t> indices;
  layer::Array<std::int32_t> holes;
};

/// Fan triangles; false when counts and indices contradict each other or the points.
bool triangulate(const Faces& faces, std::size_t point_count, bool turned, TriangleMesh& mesh) {
  std::size_t first = 0;
  for (std::size_t face = 0; face < faces.counts.size(); ++face) {
    const std::int32_t count = faces.counts[face];
    if (count < 0 || faces.indices.size() - first < static_cast<std::size_t>(count)) {
      return false;
    }
    const bool hole = std::find(faces.holes.begin(), faces.holes.end(),
                                static_cast<std::int32_t>(face)) != faces.holes.end();
    for (std::int32_t k = 0; k < count; ++k) {
      const std::int32_t index = faces.indices[first + static_cast<std::size_t>(k)];
      if (index < 0 || static_cast<std::size_t>(index) >= point_count) {
        return false;
      }
      if (k >= 2 && !hole) {
        const std::int32_t a = faces.indices[first];
        const std::int32_t b = faces.indices[first + static_cast<std::size_t>(k) - 1];
        mesh.triangles.push_back(turned ? Vec3i{{a, index, b}} : Vec3i{{a, b, index}});
      }
    }
    first += static_cast<std::size_t>(count);
  }
  return true;
}

/// S-59: a mesh without faces, or with broken ones, cannot collide.
std::optional<TriangleMesh> read_triangles(const ReadState& state, const ShapeSource& source) {
  const stage::Prim& prim = source.found.prim;
  const auto points = state.values.get<layer::Array<Vec3f>>(prim, state.tokens.points);
  Faces faces;
  faces.counts = state.values.get<layer::Array<std::int32_t>>(prim, state.tokens.face_counts)
                     .value_or(layer::Array<std::int32_t>());
  faces.indices = state.values.get<layer::Array<std::int32_t>>(prim, state.tokens.face_indices)
                      .value_or(layer::Array<std::int32_t>());
  faces.holes = state.values.get<layer::Array<std::int32_t>>(prim, state.tokens.hole_indices)
                    .value_or(layer::Array<std::int32_t>());
  TriangleMesh mesh;
  if (points) {
    mesh.points = placed_points(state, source, *points);
  }
  const bool left_handed =
      state.values.get<Token>(prim, state.tokens.orientation) == Token("leftHanded");
  const bool mirrored = determinant(upper_left(source.found.world)) < 0;
  const bool whole = triangulate(faces, mesh.points.size(), left_handed != mirrored, mesh);
  if (!whole || mesh.triangles.empty()) {
    state.report(prim, Severity::Error, "collider.mesh-invalid",
                 whole
                     ? "the mesh has no faces; it does not collide"
                     : "faceVertexCounts, faceVertexIndices and points contradict each other; the "
                       "mesh does not collide",
                 "author points, faceVertexCounts and faceVertexIndices that fit");
    return std::nullopt;
  }
  mesh.flat = is_flat(mesh.points);
  return mesh;
}

/// S-59: subdivision is not evaluated; the cage collides.
void note_subdivision(const ReadState& state, const ShapeSource& source) {
  const Token scheme = state.values.get<Token>(source.found.prim, state.tokens.subdivision_scheme)
                           .value_or(Token("none"));
  if (!(scheme == "none")) {
    state.report(source.found.prim, Severity::Info, "collider.subdivision-ignored",
                 "the mesh is a " + scheme.str() +
                     " subdivision surface; its control cage collides as it is",
                 "author subdivisionScheme = \"none\" if the cage is meant");
  }
}

ShapeReading bounded_by_box(const TriangleMesh& mesh) {
  const BoundingBox box = bounding_box(mesh.points);
  ShapeReading reading;
  reading.shape.kind = ShapeKind::Box;
  reading.shape.half_extents = box.half_extents;
  reading.pose = box.pose;
  return reading;
}

ShapeReading bounded_by_ball(const TriangleMesh& mesh) {
  const BoundingBall ball = bounding_ball(mesh.points);
  ShapeReading reading;
  reading.shape.kind = ShapeKind::Sphere;
  reading.shape.radius = ball.radius;
  reading.pose.position = ball.center;
  return reading;
}

/// What replaces the tokens that are not carried out, said aloud (S-62, S-64).
Approximation settle(ReadState& state, const ShapeSource& source, Approximation wanted) {
  const stage::Prim& prim = source.found.prim;
  if (wanted == Approximation::Decomposition) {
    state.not_read(prim, "physics:approximation",
                   "convexDecomposition is not carried out; one convex hull is used");
    return Approximation::Hull;
  }
  if (wanted == Approximation::Simplification && !source.dynamic) {
    state.not_read(prim, "physics:approximation",
                   "meshSimplification is not carried out; the mesh itself is used");
    return Approximation::None;
  }
  if (source.dynamic &&
      (wanted == Approximation::None || wanted == Approximation::Simplification)) {
    state.report(prim, Severity::Warning, "collider.dynamic-mesh",
                 "a triangle mesh on a body that moves collides as its convex hull",
                 "author physics:approximation = \"convexHull\" to say so");
    return Approximation::Hull;
  }
  return wanted;
}

}  // namespace

std::optional<ShapeReading> read_mesh_shape(ReadState& state, const ShapeSource& source) {
  std::optional<TriangleMesh> mesh = read_triangles(state, source);
  if (!mesh) {
    return std::nullopt;
  }
  note_subdivision(state, source);
  const Approximation kind = settle(state, source, approximation_of(state, source));
  if (kind == Approximation::Ball) {
    return bounded_by_ball(*mesh);
  }
  if (kind == Approximation::Box) {
    return bounded_by_box(*mesh);
  }
  ShapeReading reading;
  reading.shape.kind = kind == Approximation::Hull ? ShapeKind::ConvexHull : ShapeKind::Mesh;
  if (mesh->flat && kind == Approximation::Hull) {
    // S-65
    state.report(source.found.prim, Severity::Info, "collider.flat-hull",
                 "the points lie in one plane: the hull is a flat polygon, solid from both sides",
                 "give the mesh a thickness, or use a Plane or a thin Cube");
  }
  reading.shape.mesh = add_mesh(state, *std::move(mesh));
  return reading;
}

std::optional<ShapeReading> read_points_shape(ReadState& state, const ShapeSource& source) {
  const stage::Prim& prim = source.found.prim;
  const auto points = state.values.get<layer::Array<Vec3f>>(prim, state.tokens.points);
  auto widths = state.values.get<layer::Array<float>>(prim, state.tokens.primvar_widths);
  if (!widths) {
    widths = state.values.get<layer::Array<float>>(prim, state.tokens.widths);
  }
  // S-58
  const bool fits = points && widths && !points->empty() &&
                    (widths->size() == points->size() || widths->size() == 1);
  if (!fits) {
    state.report(prim, Severity::Error, "collider.points-invalid",
                 "Points need one width per point; they do not collide",
                 "author as many widths as points");
    return std::nullopt;
  }
  const Vec3d& s = source.parts.scale;
  const double scale =
      std::fmax(std::fabs(s[0]), std::fmax(std::fabs(s[1]), std::fabs(s[2]))) * state.units.length;
  ShapeReading reading;
  reading.shape.kind = ShapeKind::Spheres;
  reading.shape.sphere_centers = placed_points(state, source, *points);
  for (std::size_t i = 0; i < points->size(); ++i) {
    const float width = (*widths)[widths->size() == 1 ? 0 : i];
    reading.shape.sphere_radii.push_back(std::fabs(static_cast<double>(width)) / 2 * scale);
  }
  return reading;
}

}  // namespace tenon::physics
