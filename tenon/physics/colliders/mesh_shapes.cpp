// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Points are moved by the whole matrix of their prim into the collider's rigid frame, so any scale
// and shear is exact. Faces become fans; the winding is turned when either the orientation is
// left-handed or the matrix mirrors, but not both. The mesh is approximated as the asset asks for,
// changed where the body moves (S-64) or where that is not possible, and each change is reported. A
// face of n corners makes n - 2 triangles in the order of faces, from which subsets of faces find
// theirs. Meshes made from the same arrays and placement may come from a cache.
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>

#include "tenon/base/limits/physics_limits.h"
#include "tenon/physics/colliders/shapes.h"
#include "tenon/physics/read_physics.h"
#include "tenon/physics/world_pose.h"
#include "tenon/scene/shapes/convex_hull.h"
#include "tenon/stage/collections/material_binding.h"
#include "tenon/stage/transform_at.h"

namespace tenon::physics {
namespace {

std::optional<Approximation> asked_instead(const ReadState& state, const ShapeSource& source) {
  return state.asked != nullptr ? (*state.asked)(source.found.prim) : std::nullopt;
}

Approximation approximation_of(const ReadState& state, const ShapeSource& source) {
  if (const auto asked = asked_instead(state, source)) {
    return *asked;
  }
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
  for (int i = 0; i <= static_cast<int>(Approximation::SphereFill); ++i) {
    if (token == approximation_name(static_cast<Approximation>(i))) {
      return static_cast<Approximation>(i);
    }
  }
  state.report(found.prim, name, Severity::Warning, "collider.approximation-unknown",
               "physics:approximation is \"" + token.str() + "\"; " +
                   (source.dynamic ? "the convex hull" : "the mesh itself") + " is used instead",
               "use none, convexHull, convexDecomposition, meshSimplification, boundingSphere or "
               "boundingCube");
  return source.dynamic ? Approximation::ConvexHull : Approximation::None;
}

std::vector<std::int32_t> sorted(const layer::Array<std::int32_t>& array) {
  std::vector<std::int32_t> numbers(array.begin(), array.end());
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

bool is_hole(const std::vector<std::int32_t>& holes, std::size_t face) {
  return std::binary_search(holes.begin(), holes.end(), static_cast<std::int32_t>(face));
}

/// A mesh prim under the matrix `world` in the collider's rigid frame, without its arrays.
MeshSource placed_source(const ReadState& state, const ShapeSource& source, const Mat4d& world) {
  MeshSource mesh;
  mesh.linear = upper_left(world);
  mesh.offset = Vec3d{{world[3][0], world[3][1], world[3][2]}} - source.parts.translation;
  mesh.turn = conjugate(source.frame.orientation);
  mesh.length = state.units.length;
  return mesh;
}

/// Points in the collider's rigid frame, exact under any matrix of their prim [m].
std::vector<Vec3d> placed_points(const MeshSource& mesh) {
  const Mat3d m = mesh.linear;
  std::vector<Vec3d> placed;
  placed.reserve(mesh.points.size());
  for (const Vec3f& point : mesh.points) {
    const Vec3d p = to_double(point);
    Vec3d moved = mesh.offset;
    for (std::size_t j = 0; j < 3; ++j) {
      moved[j] = (p[0] * m[0][j] + p[1] * m[1][j] + p[2] * m[2][j]) + mesh.offset[j];
    }
    placed.push_back(rotate(mesh.turn, moved) * mesh.length);
  }
  return placed;
}

/// The corners of all faces, one face after the other; nothing when counts and indices contradict
/// each other or the points.
std::optional<std::span<const std::int32_t>> corners_of(const MeshSource& faces) {
  const std::span<const std::int32_t> indices = faces.indices.span();
  std::size_t count = 0;
  for (const std::int32_t corners : faces.counts) {
    if (corners < 0 || indices.size() - count < static_cast<std::size_t>(corners)) {
      return std::nullopt;
    }
    count += static_cast<std::size_t>(corners);
  }
  const std::span<const std::int32_t> corners = indices.first(count);
  std::uint32_t last = 0;  // as unsigned numbers, negative ones are the largest
  for (const std::int32_t corner : corners) {
    last = std::max(last, static_cast<std::uint32_t>(corner));
  }
  const bool sound = corners.empty() || last < faces.points.size();
  return sound && last <= std::uint32_t{INT32_MAX} ? std::optional(corners) : std::nullopt;
}

/// Fan triangles; false when counts and indices contradict each other or the points.
bool triangulate(const MeshSource& faces, TriangleMesh& mesh) {
  const auto corners = corners_of(faces);
  if (!corners) {
    return false;
  }
  const std::size_t shared = 2 * faces.counts.size();  // corners that begin no triangle
  mesh.triangles.reserve(corners->size() - std::min(corners->size(), shared));
  const std::vector<std::int32_t> holes = sorted(faces.holes);
  const std::int32_t* first = corners->data();
  const std::size_t second = faces.flipped ? 1 : 0;
  std::size_t face = 0;
  for (const std::int32_t count : faces.counts) {
    const bool hole = !holes.empty() && is_hole(holes, face);
    for (std::int32_t k = 2; k < count && !hole; ++k) {
      mesh.triangles.push_back({{first[0], first[k - 1 + second], first[k - second]}});
    }
    first += count;
    ++face;
  }
  return true;
}

layer::Array<std::int32_t> integers(const ReadState& state, const stage::Prim& prim, Token name) {
  return state.values.get<layer::Array<std::int32_t>>(prim, name)
      .value_or(layer::Array<std::int32_t>());
}

MeshSource read_source(const ReadState& state, const ShapeSource& source, const stage::Prim& prim,
                       const Mat4d& world) {
  MeshSource mesh = placed_source(state, source, world);
  mesh.points = state.values.get<layer::Array<Vec3f>>(prim, state.tokens.points)
                    .value_or(layer::Array<Vec3f>());
  const bool left_handed =
      state.values.get<Token>(prim, state.tokens.orientation) == Token("leftHanded");
  const bool mirrored = determinant(mesh.linear) < 0;
  mesh.flipped = left_handed != mirrored;
  mesh.holes = integers(state, prim, state.tokens.hole_indices);
  mesh.counts = integers(state, prim, state.tokens.face_counts);
  mesh.indices = integers(state, prim, state.tokens.face_indices);
  return mesh;
}

/// S-59: a mesh without faces, or with broken ones, cannot collide.
std::optional<TriangleMesh> read_triangles(const ReadState& state, const stage::Prim& prim,
                                           const MeshSource& made_from) {
  if (state.mesh_cache != nullptr) {
    if (const TriangleMesh* known = state.mesh_cache->find(made_from)) {
      return *known;
    }
  }
  TriangleMesh mesh;
  mesh.points = placed_points(made_from);
  const bool whole = triangulate(made_from, mesh);
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
  if (state.mesh_cache != nullptr) {
    state.mesh_cache->add(made_from, mesh);
  }
  return mesh;
}

/// Mesh prims below a mesh that collides, without the API of their own (S-61).
std::vector<stage::Prim> submeshes(const stage::Prim& prim) {
  std::vector<stage::Prim> found;
  std::vector<stage::Prim> pending = prim.children();
  while (!pending.empty()) {
    const stage::Prim next = pending.back();
    pending.pop_back();
    const bool counts = next.is_active() && next.is_defined() && !next.is_abstract();
    if (!counts || next.has_api("PhysicsCollisionAPI") || next.has_api("PhysicsRigidBodyAPI")) {
      continue;
    }
    if (next.is_a("Mesh")) {
      found.push_back(next);
    }
    const std::vector<stage::Prim> children = next.children();
    pending.insert(pending.end(), children.rbegin(), children.rend());
  }
  return found;
}

void append(const TriangleMesh& part, TriangleMesh& mesh) {
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), part.points.begin(), part.points.end());
  for (const Vec3i& t : part.triangles) {
    mesh.triangles.push_back({{t[0] + first, t[1] + first, t[2] + first}});
  }
}

void add_submeshes(const ReadState& state, const ShapeSource& source,
                   const std::vector<stage::Prim>& parts, TriangleMesh& mesh) {
  for (const stage::Prim& prim : parts) {
    const Mat4d world = state.walk.world_near(source.found, prim, state.values.start());
    if (const auto part = read_triangles(state, prim, read_source(state, source, prim, world))) {
      append(*part, mesh);
    }
  }
  if (!parts.empty()) {
    mesh.flat = is_flat(mesh.points);
    state.report(source.found.prim, Severity::Warning, "collider.submeshes",
                 std::to_string(parts.size()) +
                     " meshes below this one are part of its collider, as the proposal says; no "
                     "engine does it",
                 "apply PhysicsCollisionAPI to each mesh that is to collide");
  }
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

/// What replaces triangles on bodies that move, said aloud (S-64).
Approximation settle(ReadState& state, const ShapeSource& source, Approximation wanted) {
  if (wanted == Approximation::Sdf || wanted == Approximation::SphereFill) {
    const char* const instead =
        source.dynamic ? "PhysX's own; the pieces of the convex decomposition collide instead"
                       : "PhysX's own; the mesh itself collides instead";
    state.not_read(source.found.prim, "physics:approximation", instead);
    return source.dynamic ? Approximation::ConvexDecomposition : Approximation::None;
  }
  if (source.dynamic &&
      (wanted == Approximation::None || wanted == Approximation::MeshSimplification)) {
    state.report(source.found.prim, Severity::Warning, "collider.dynamic-mesh",
                 "a triangle mesh on a body that moves collides as its convex hull",
                 "author physics:approximation = \"convexHull\" to say so");
    return Approximation::ConvexHull;
  }
  return wanted;
}

bool all_finite(const TriangleMesh& mesh) {
  return std::all_of(mesh.points.begin(), mesh.points.end(),
                     [](const Vec3d& point) { return is_finite(point); });
}

void not_carried_out(ReadState& state, const ShapeSource& source, const char* why) {
  state.not_read(source.found.prim, "physics:approximation", why);
}

/// S-62: the triangles of a mesh, fewer where they can be.
void simplify(ReadState& state, const ShapeSource& source, TriangleMesh& mesh) {
  std::optional<TriangleMesh> fewer;
  if (state.mesh_tools != nullptr && state.mesh_tools->simplify) {
    fewer = state.mesh_tools->simplify(mesh);
  }
  if (!fewer) {
    not_carried_out(state, source,
                    "meshSimplification is not carried out; the mesh itself is used");
  } else if (!fewer->triangles.empty()) {
    fewer->flat = mesh.flat;
    mesh = *std::move(fewer);
  }
}

/// The most hulls and corners that PhysX makes; its settings where they are authored.
int most_of(const ReadState& state, const ShapeSource& source, const char* name, int fallback) {
  const double most = state.values.authored_number(source.found.prim, name).value_or(fallback);
  return most >= 1 && most <= 2048 ? static_cast<int>(most) : fallback;
}

/// PhysX's error in per cent of the volume; its default of 10 is the library's own.
double concavity_of(const ReadState& state, const ShapeSource& source) {
  const double error =
      state.values
          .authored_number(source.found.prim, "physxConvexDecompositionCollision:errorPercentage")
          .value_or(10);
  return std::clamp(error, 0.2, 100.0) / 200;  // the library takes 0.001 to 0.5 here
}

/// S-62: convex pieces of a mesh, into the scene; none when it is left whole, said why.
std::vector<Index> decompose(ReadState& state, const ShapeSource& source,
                             const TriangleMesh& mesh) {
  const char* const left_out = "convexDecomposition is not carried out; one convex hull is used";
  const char* fault = nullptr;
  std::optional<std::vector<TriangleMesh>> pieces;
  if (state.mesh_tools == nullptr || !state.mesh_tools->decompose) {
    fault = left_out;
  } else if (mesh.flat) {
    return {};  // one polygon, said as such
  } else if (!is_closed(mesh)) {
    fault = "the mesh is open, so it has no inside to decompose; one convex hull is used";
  } else if (mesh.triangles.size() > limits::kDecomposedTriangles) {
    fault = "the mesh has too many triangles to decompose; one convex hull is used";
  } else {
    const std::string space = "physxConvexDecompositionCollision:";
    pieces = state.mesh_tools->decompose(
        mesh, {most_of(state, source, (space + "maxConvexHulls").c_str(), 32),
               std::max(4, most_of(state, source, (space + "hullVertexLimit").c_str(), 64)),
               concavity_of(state, source)});
    if (!pieces) {
      fault = left_out;
    } else if (pieces->empty()) {
      fault = "convexDecomposition failed; one convex hull is used";
    }
  }
  if (fault != nullptr) {
    not_carried_out(state, source, fault);
  }
  std::vector<Index> indices;
  if (pieces) {
    for (TriangleMesh& piece : *pieces) {
      indices.push_back(add_mesh(state, std::move(piece)));
    }
  }
  return indices;
}

/// A mesh that represents an ellipsoid and has its semi-axes (docs/conversion.md). Nothing where
/// its scale shears these, or another approximation is asked for.
std::optional<ShapeReading> read_ellipsoid(const ReadState& state, const ShapeSource& source) {
  const auto axes = source.found.prim.attribute(state.tokens.ellipsoid).get_as<Vec3d>();
  const auto kind = source.found.prim.attribute(state.tokens.approximation).get_as<Token>();
  const auto asked = asked_instead(state, source);
  const bool is_hull = asked ? *asked == Approximation::ConvexHull : kind && *kind == "convexHull";
  if (!axes || source.parts.sheared || !is_hull) {
    return std::nullopt;
  }
  ShapeReading reading;
  reading.shape.kind = ShapeKind::Ellipsoid;
  for (std::size_t i = 0; i < 3; ++i) {
    const double half = (*axes)[i] * std::fabs(source.parts.scale[i]) * state.units.length;
    if (!(half > 0) || !std::isfinite(half)) {
      return std::nullopt;
    }
    reading.shape.half_extents[i] = half;
  }
  return reading;
}

/// The arrays of a mesh are there, and not to be read.
bool is_skipped(const ReadState& state, const ShapeSource& source) {
  if (state.static_meshes == StaticMeshes::Read || source.on_body) {
    return false;
  }
  const stage::Prim& prim = source.found.prim;
  const Token arrays[] = {state.tokens.points, state.tokens.face_counts, state.tokens.face_indices};
  return std::all_of(std::begin(arrays), std::end(arrays),
                     [&](Token name) { return prim.attribute(name).has_authored_value(); });
}

/// What can be said of a mesh without its arrays.
ShapeReading read_mesh_settings(ReadState& state, const ShapeSource& source) {
  note_subdivision(state, source);
  ShapeReading reading;
  reading.approximation = approximation_of(state, source);
  settle(state, source, *reading.approximation);
  reading.shape.kind = ShapeKind::Mesh;
  reading.shape.mesh = add_mesh(state, TriangleMesh());
  return reading;
}

std::optional<ShapeReading> read_faces(ReadState& state, const ShapeSource& source) {
  const stage::Prim& prim = source.found.prim;
  const MeshSource made_from = read_source(state, source, prim, source.found.world);
  const std::vector<stage::Prim> parts = submeshes(prim);
  const std::optional<Index> shared =
      parts.empty() ? state.shared_meshes.find(made_from) : std::nullopt;
  TriangleMesh made;
  if (!shared) {
    std::optional<TriangleMesh> read = read_triangles(state, prim, made_from);
    if (!read) {
      return std::nullopt;
    }
    made = *std::move(read);
    add_submeshes(state, source, parts, made);
  }
  const TriangleMesh& mesh = shared ? state.scene.meshes[*shared] : made;
  note_subdivision(state, source);
  const Approximation asked = approximation_of(state, source);
  const Approximation kind = settle(state, source, asked);
  ShapeReading reading;
  if (!shared && !all_finite(mesh)) {  // nothing can approximate it; the caller reports it
    reading.shape.kind = ShapeKind::Mesh;
    reading.shape.mesh = add_mesh(state, std::move(made));
    return reading;
  }
  if (kind == Approximation::BoundingSphere || kind == Approximation::BoundingCube) {
    reading = kind == Approximation::BoundingCube ? bounded_by_box(mesh) : bounded_by_ball(mesh);
    reading.approximation = asked;
    return reading;
  }
  reading.approximation = asked;
  const bool hull = kind == Approximation::ConvexHull || kind == Approximation::ConvexDecomposition;
  reading.shape.kind = hull ? ShapeKind::ConvexHull : ShapeKind::Mesh;
  if (mesh.flat && hull) {
    // S-65
    state.report(prim, Severity::Info, "collider.flat-hull",
                 "the points are in one plane: the hull is a flat polygon, solid from both sides",
                 "give the mesh a thickness, or use a Plane or a thin Cube");
  }
  if (kind == Approximation::MeshSimplification) {
    if (shared) {
      made = mesh;
    }
    simplify(state, source, made);
    reading.shape.mesh = add_mesh(state, std::move(made));
    return reading;
  }
  if (kind == Approximation::ConvexDecomposition) {
    reading.shape.pieces = decompose(state, source, mesh);
  }
  reading.shape.mesh = shared ? *shared : add_mesh(state, std::move(made));
  if (!shared && parts.empty()) {
    state.shared_meshes.add(made_from, reading.shape.mesh);
  }
  return reading;
}

}  // namespace

std::optional<ShapeReading> read_mesh_shape(ReadState& state, const ShapeSource& source) {
  if (auto ellipsoid = read_ellipsoid(state, source)) {
    return ellipsoid;
  }
  return is_skipped(state, source) ? read_mesh_settings(state, source) : read_faces(state, source);
}

namespace {

/// First triangle of each face, and one past the last: holes and degenerate faces have none.
std::vector<Index> first_triangles(const ReadState& state, const stage::Prim& prim) {
  const layer::Array<std::int32_t> counts = integers(state, prim, state.tokens.face_counts);
  const std::vector<std::int32_t> holes = sorted(integers(state, prim, state.tokens.hole_indices));
  std::vector<Index> first{0};
  for (std::size_t face = 0; face < counts.size(); ++face) {
    const std::int32_t count = is_hole(holes, face) ? 0 : std::max(2, counts[face]) - 2;
    first.push_back(first.back() + static_cast<Index>(count));
  }
  return first;
}

std::vector<Index> triangles_of(const layer::Array<std::int32_t>& faces,
                                const std::vector<Index>& first) {
  std::vector<Index> triangles;
  for (const std::int32_t face : faces) {
    if (face < 0 || static_cast<std::size_t>(face) + 1 >= first.size()) {
      continue;
    }
    for (Index i = first[static_cast<std::size_t>(face)];
         i < first[static_cast<std::size_t>(face) + 1]; ++i) {
      triangles.push_back(i);
    }
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

}  // namespace

void read_face_materials(ReadState& state, Index index) {
  if (state.static_meshes == StaticMeshes::Skipped && !state.scene.colliders[index].body) {
    return;
  }
  const stage::Prim& prim = state.prim_of_collider(index).prim;
  std::vector<Index> first;
  for (const stage::Prim& child : prim.children()) {
    if (!(child.type_name() == "GeomSubset") ||
        state.values.get<Token>(child, "elementType").value_or(Token("face")) != Token("face")) {
      continue;
    }
    const Path bound = stage::find_material_binding(child, Token("physics")).material;
    const auto found = state.material_of_path.find(bound);
    std::optional<Index> material;
    if (found != state.material_of_path.end()) {
      material = found->second;
    }
    Collider& collider = state.scene.colliders[index];
    if (material == collider.material) {
      continue;
    }
    if (collider.shape.kind != ShapeKind::Mesh) {
      state.not_read(
          child, "material:binding",
          "the mesh's approximation does not keep its faces; the material of the mesh counts");
      continue;
    }
    const auto faces = state.values.get<layer::Array<std::int32_t>>(child, "indices");
    if (first.empty()) {
      first = first_triangles(state, prim);
    }
    if (collider.approximation == Approximation::MeshSimplification &&
        state.scene.meshes[collider.shape.mesh].triangles.size() != first.back()) {
      state.not_read(child, "material:binding",
                     "the simplified mesh has other triangles; the material of the mesh counts");
      continue;
    }
    collider.face_materials.push_back(
        {child.path(), material,
         triangles_of(faces.value_or(layer::Array<std::int32_t>()), first)});
  }
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
  MeshSource centers = placed_source(state, source, source.found.world);
  centers.points = *points;
  reading.shape.sphere_centers = placed_points(centers);
  for (std::size_t i = 0; i < points->size(); ++i) {
    const float width = (*widths)[widths->size() == 1 ? 0 : i];
    reading.shape.sphere_radii.push_back(std::fabs(static_cast<double>(width)) / 2 * scale);
  }
  return reading;
}

}  // namespace tenon::physics
