// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Colliders become geoms of their body's MuJoCo body. A static collider gets a MuJoCo body of its
// own without joints, so that body pairs can be excluded one by one and animated ones can move. Of
// more than 1000, and in text, only those that need it get one, as the search for contacts takes
// room for every pair of bodies, and models of others have them in the world. Shapes that MuJoCo
// does not have become convex pieces. Geoms and mesh points are counted as they are made, and the
// pass ends where a model would become too large.
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "tenon/engines/mujoco/build/build.h"
#include "tenon/engines/mujoco/build/mesh_pieces.h"
#include "tenon/engines/mujoco/build/model_size.h"
#include "tenon/scene/filter_sets.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Collider;
using scene::Shape;
using scene::ShapeKind;

constexpr int kConeSides = 48;
constexpr double kSmallestSize = 1e-9;  // [m]

// Rotation that brings MuJoCo's z to the shape's axis.
Quatd axis_rotation(scene::Axis axis) {
  switch (axis) {
    case scene::Axis::X:
      return rotation_about({{0, 1, 0}}, M_PI / 2);
    case scene::Axis::Y:
      return rotation_about({{1, 0, 0}}, -M_PI / 2);
    case scene::Axis::Z:
      break;
  }
  return kIdentityRotation;
}

// Triangles of one material, in a mesh of their own.
struct MaterialPart {
  std::optional<scene::Index> material;
  scene::TriangleMesh mesh;
};

scene::TriangleMesh part_of(const scene::TriangleMesh& mesh, const std::vector<int>& kinds,
                            int kind) {
  std::vector<int> place(mesh.points.size(), -1);
  scene::TriangleMesh part;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (kinds[i] != kind) {
      continue;
    }
    Vec3i& t = part.triangles.emplace_back(mesh.triangles[i]);
    for (int& corner : t.v) {
      int& at = place[static_cast<std::size_t>(corner)];
      if (at < 0) {
        at = static_cast<int>(part.points.size());
        part.points.push_back(mesh.points[static_cast<std::size_t>(corner)]);
      }
      corner = at;
    }
  }
  return part;
}

// A mesh whose faces have several materials, one part per material (S-70).
std::vector<MaterialPart> parts_by_material(const Collider& collider,
                                            const scene::TriangleMesh& mesh) {
  if (collider.face_materials.empty()) {
    return {{collider.material, mesh}};
  }
  std::vector<int> kinds(mesh.triangles.size(), -1);
  std::vector<MaterialPart> parts;
  const int count = static_cast<int>(collider.face_materials.size());
  for (int i = 0; i < count; ++i) {
    for (const scene::Index t : collider.face_materials[static_cast<std::size_t>(i)].triangles) {
      if (t < kinds.size() && kinds[t] < 0) {
        kinds[t] = i;
      }
    }
  }
  for (int i = -1; i < count; ++i) {
    scene::TriangleMesh part = part_of(mesh, kinds, i);
    if (!part.triangles.empty()) {
      parts.push_back({i < 0 ? collider.material
                             : collider.face_materials[static_cast<std::size_t>(i)].material,
                       std::move(part)});
    }
  }
  return parts;
}

void set_contact(mjsGeom& geom, const scene::MujocoContact& contact) {
  geom.condim = contact.condim.value_or(geom.condim);
  geom.priority = contact.priority.value_or(geom.priority);
  geom.solmix = contact.solmix.value_or(geom.solmix);
  std::copy(contact.solimp.begin(), contact.solimp.end(), geom.solimp);
}

/// Up to so many static colliders each have a MuJoCo body. Of more, only those that need one have:
/// MuJoCo's search for contacts takes room for every pair of bodies.
constexpr std::size_t kOwnStaticBodies = 1000;
constexpr std::size_t kRoomPerPair = 8;  // [bytes]

/// Which static colliders have a body of their own: pairs that are switched off are told by their
/// bodies, and what moves along a track is one.
std::vector<char> own_static_bodies(const scene::PhysicsScene& scene, Purpose purpose) {
  std::vector<char> own(scene.colliders.size(), 1);
  const auto is_static = [](const Collider& c) { return c.enabled && !c.body.has_value(); };
  const auto count = std::count_if(scene.colliders.begin(), scene.colliders.end(), is_static);
  if (purpose == Purpose::Run && static_cast<std::size_t>(count) <= kOwnStaticBodies) {
    return own;
  }
  std::fill(own.begin(), own.end(), 0);
  std::set<scene::Index> sets;  // that are kept apart from others
  for (const auto& [first, second] : scene.filter.sets_off) {
    sets.insert({first, second});
  }
  for (scene::Index i = 0; i < scene.colliders.size(); ++i) {
    const std::vector<scene::Index>& of = scene::sets_of(scene.filter, i);
    own[i] =
        std::any_of(of.begin(), of.end(), [&](scene::Index set) { return sets.contains(set); });
  }
  for (const scene::PoseTrack& track : scene.pose_tracks) {
    if (track.collider.has_value()) {
      own[*track.collider] = 1;
    }
  }
  return own;
}

class ColliderPass {
 public:
  ColliderPass(Build& build, scene::Index index, bool own_body)
      : build_(build),
        own_body_(own_body),
        index_(index),
        collider_(build.scene.colliders[index]),
        material_(collider_.material) {}

  std::size_t mesh_points() const { return mesh_points_; }

  void add() {
    find_place();
    if (build_.refused.contains(collider_.path)) {
      build_.report(collider_.path, "extent", "MuJoCo refuses the shape; skipped");
      return;
    }
    if (!has_size()) {
      build_.report(collider_.path, "extent", "MuJoCo has no shape of size zero; skipped");
      return;
    }
    add_shape();
    for (mjsGeom* geom : build_.geoms[index_]) {
      if (collider_.rest_offset.has_value()) {
        geom->margin = *collider_.rest_offset;
      }
      set_contact(*geom, collider_.parts.mujoco);
      set_surface(*geom);
      if (collider_.contact_offset.has_value()) {
        geom->gap = std::max(0.0, *collider_.contact_offset - geom->margin);
      }
    }
  }

 private:
  /// MuJoCo counts both velocities in the geom's own frame.
  void set_surface(mjsGeom& geom) {
    const scene::ColliderSettings& settings = collider_.settings;
    if (settings.torsional_patch > 0 || settings.min_torsional_patch > 0) {
      geom.condim = std::max(geom.condim, 4);
    }
    if (!settings.surface_velocity || !collider_.body) {
      return;
    }
    const scene::SurfaceVelocity& surface = *settings.surface_velocity;
    const Pose& frame = build_.engine_frames[*collider_.body];
    const Pose in_body = frame * Pose{read_vector(geom.pos), read_quaternion(geom.quat)};
    Vec3d linear = surface.linear;
    Vec3d angular = surface.angular;
    if (!surface.body_axes) {
      const Quatd world = build_.scene.bodies[*collider_.body].pose.orientation;
      linear = rotate(conjugate(world), linear);
      angular = rotate(conjugate(world), angular);
      if (!is_static_) {
        build_.report(collider_.path, "surfaceVelocity",
                      "MuJoCo lets it turn with the body; it is that of the start");
      }
    }
    linear += cross(angular, in_body.position);
    write_vector(geom.surfacevel, rotate(conjugate(in_body.orientation), linear));
    write_vector(geom.surfacevel + 3, rotate(conjugate(in_body.orientation), angular));
  }

  void find_place() {
    if (collider_.body.has_value()) {
      body_ = build_.bodies[*collider_.body];
      pose_ = inverse(build_.engine_frames[*collider_.body]) * collider_.pose;
      is_static_ = build_.plan.bases[*collider_.body] == BodyBase::Fixed;
      moves_freely_ = build_.scene.is_dynamic(collider_.body);
      world_ = build_.scene.bodies[*collider_.body].pose * collider_.pose;
      return;
    }
    mjsBody* const world = mjs_findBody(build_.spec.get(), "world");
    is_static_ = true;
    world_ = collider_.pose;
    if (!own_body_) {
      body_ = world;
      pose_ = collider_.pose;
      return;
    }
    body_ = mjs_addBody(world, nullptr);
    place(body_, collider_.path.str() + ".static", collider_.pose);
    build_.static_bodies[index_] = body_;
    for (const scene::PoseTrack& track : build_.scene.pose_tracks) {
      if (track.collider == index_ && !track.times.empty()) {
        body_->mocap = 1;
      }
    }
    is_static_ = body_->mocap == 0;
  }

  bool has_size() const {
    const Shape& shape = collider_.shape;
    switch (shape.kind) {
      case ShapeKind::Box:
      case ShapeKind::Ellipsoid:
        return std::min({shape.half_extents[0], shape.half_extents[1], shape.half_extents[2]}) >
               kSmallestSize;
      case ShapeKind::Sphere:
        return shape.radius > kSmallestSize;
      case ShapeKind::Capsule:
      case ShapeKind::Cylinder:
      case ShapeKind::Cone:
        return shape.radius > kSmallestSize && shape.half_height > kSmallestSize;
      case ShapeKind::Plane:
      case ShapeKind::ConvexHull:
      case ShapeKind::Mesh:
      case ShapeKind::Spheres:
        break;
    }
    return true;
  }

  mjsGeom* add_geom(mjtGeom type, const Pose& in_collider, const Vec3d& size) {
    mjsGeom* geom = mjs_addGeom(body_, nullptr);
    std::vector<mjsGeom*>& geoms = build_.geoms[index_];
    const std::string suffix = geoms.empty() ? "" : "." + std::to_string(geoms.size());
    mjs_setName(geom->element, (collider_.path.str() + suffix).c_str());
    geom->type = type;
    const Pose pose = pose_ * in_collider;
    write_vector(geom->pos, pose.position);
    write_quaternion(geom->quat, normalized(pose.orientation));
    write_vector(geom->size, size);
    geoms.push_back(geom);
    build_.geom_materials[index_].push_back(material_);
    return geom;
  }

  void add_shape() {
    const Shape& shape = collider_.shape;
    const Pose rotated{{}, axis_rotation(shape.axis)};
    switch (shape.kind) {
      case ShapeKind::Box:
        add_geom(mjGEOM_BOX, {}, shape.half_extents);
        break;
      case ShapeKind::Ellipsoid:
        add_geom(mjGEOM_ELLIPSOID, {}, shape.half_extents);
        break;
      case ShapeKind::Sphere:
        add_geom(mjGEOM_SPHERE, {}, {{shape.radius, 0, 0}});
        break;
      case ShapeKind::Capsule:
        add_geom(mjGEOM_CAPSULE, rotated, {{shape.radius, shape.half_height, 0}});
        break;
      case ShapeKind::Cylinder:
        add_geom(mjGEOM_CYLINDER, rotated, {{shape.radius, shape.half_height, 0}});
        break;
      case ShapeKind::Cone:
        add_cone();
        break;
      case ShapeKind::Plane:
        add_plane(rotated);
        break;
      case ShapeKind::ConvexHull:
        add_hulls();
        break;
      case ShapeKind::Mesh:
        add_mesh();
        break;
      case ShapeKind::Spheres:
        for (std::size_t i = 0; i < shape.sphere_centers.size(); ++i) {
          add_geom(mjGEOM_SPHERE, {shape.sphere_centers[i]}, {{shape.sphere_radii[i], 0, 0}});
        }
        break;
    }
  }

  void add_cone() {
    const Shape& shape = collider_.shape;
    const Quatd rotated = axis_rotation(shape.axis);
    std::vector<Vec3d> points{rotate(rotated, {{0, 0, shape.half_height}})};
    for (int i = 0; i < kConeSides; ++i) {
      const double angle = 2 * M_PI * i / kConeSides;
      points.push_back(rotate(rotated, {{shape.radius * std::cos(angle),
                                         shape.radius * std::sin(angle), -shape.half_height}}));
    }
    add_pieces({{points}, ""});
    build_.report(collider_.path, "radius",
                  "MuJoCo has no cone; the hull of a base with 48 corners is used");
  }

  void add_plane(const Pose& rotated) {
    if (!is_static_) {
      build_.report(collider_.path, "axis", "MuJoCo planes cannot move; skipped");
      return;
    }
    add_geom(mjGEOM_PLANE, rotated, {{0, 0, 1}});
  }

  void add_hulls() {
    const Shape& shape = collider_.shape;
    for (const scene::Index piece : shape.pieces) {
      add_pieces(hull_pieces(build_.scene.meshes[piece].points, up()));
    }
    if (shape.pieces.empty()) {
      add_pieces(hull_pieces(build_.scene.meshes[shape.mesh].points, up()));
    }
  }

  void add_mesh() {
    const scene::TriangleMesh& mesh = build_.scene.meshes[collider_.shape.mesh];
    if (!moves_freely_) {
      for (const MaterialPart& part : parts_by_material(collider_, mesh)) {
        material_ = part.material;
        add_pieces(triangle_pieces(part.mesh, up()));
      }
      return;
    }
    for (const scene::FaceMaterial& faces : collider_.face_materials) {
      build_.report(faces.subset, "material:binding",
                    "the convex hull of the moving mesh has one material, that of the mesh");
    }
    add_pieces(hull_pieces(mesh.points, up()));
    build_.report(collider_.path, "physics:approximation",
                  "MuJoCo has no contacts with moving triangle meshes; the convex hull is used");
  }

  void add_pieces(const MeshPieces& pieces) {
    if (!pieces.note.empty()) {
      build_.report(collider_.path, "physics:approximation", pieces.note);
    }
    for (const std::vector<Vec3d>& hull : pieces.hulls) {
      const std::string name = mesh_of(hull);
      mjs_setString(add_geom(mjGEOM_MESH, {}, {})->meshname, name.c_str());
    }
  }

  /// The name of MuJoCo's mesh with these corners, made for the first collider that has them.
  std::string mesh_of(const std::vector<Vec3d>& hull) {
    MeshKey key;
    for (const Vec3d& p : hull) {
      for (const double x : p.v) {
        key.points.push_back(static_cast<float>(x));
      }
    }
    if (collider_.max_hull_vertices.has_value() && *collider_.max_hull_vertices > 3) {
      key.most_vertices = *collider_.max_hull_vertices;
    }
    const auto [known, is_new] = build_.mesh_names.try_emplace(std::move(key));
    if (is_new) {
      known->second = collider_.path.str() + ".mesh" + std::to_string(build_.geoms[index_].size());
      mjsMesh* mesh = mjs_addMesh(build_.spec.get(), nullptr);
      mjs_setName(mesh->element, known->second.c_str());
      const std::vector<float>& points = known->first.points;
      mjs_setFloat(mesh->uservert, points.data(), static_cast<int>(points.size()));
      mesh->inertia = mjMESH_INERTIA_CONVEX;
      if (known->first.most_vertices > 0) {
        mesh->maxhullvert = known->first.most_vertices;
      }
      mesh_points_ += hull.size();
    }
    return known->second;
  }

  // Against gravity, in the collider's frame.
  Vec3d up() const {
    const Vec3d& gravity = build_.scene.scenes[collider_.scene].gravity;
    return moves_freely_ ? Vec3d{} : -rotate(conjugate(world_.orientation), gravity);
  }

  Build& build_;
  bool own_body_;  // of a static collider
  scene::Index index_;
  const Collider& collider_;
  std::optional<scene::Index> material_;  // of the geoms made next
  mjsBody* body_ = nullptr;
  Pose pose_;   // of the collider in the MuJoCo body
  Pose world_;  // of the collider at the start
  bool is_static_ = false;
  bool moves_freely_ = false;
  std::size_t mesh_points_ = 0;
};

}  // namespace

Result<void> add_geoms(Build& build) {
  const std::size_t count = build.scene.colliders.size();
  build.geoms.assign(count, {});
  build.geom_materials.assign(count, {});
  build.static_bodies.assign(count, nullptr);
  const std::vector<char> own_body = own_static_bodies(build.scene, build.purpose);
  ModelSize size;
  std::size_t own_bodies = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (build.scene.colliders[i].enabled) {
      ColliderPass pass(build, static_cast<scene::Index>(i), own_body[i] != 0);
      pass.add();
      size.geoms += build.geoms[i].size();
      size.mesh_points += pass.mesh_points();
      TENON_CHECK(check_model_size(size, build.scene.colliders[i].path));
      own_bodies += build.static_bodies[i] == nullptr ? 0 : 1;
    }
  }
  if (build.purpose == Purpose::Run && own_bodies > kOwnStaticBodies) {
    const std::size_t bodies = own_bodies + build.scene.bodies.size();
    build.spec->memory += static_cast<mjtSize>(kRoomPerPair * bodies * bodies / 2);
  }
  return {};
}

}  // namespace tenon::engines::mujoco
