// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The model is that of a run of another scene: the same bodies and shapes, without joints and
// filters, every body free. So no two of them are welded together, and MuJoCo's own rules about
// parents and what stands still do not apply. Mass, velocities and surfaces do not matter. A free
// body cannot have the triangles of a mesh, which kinematic ones have, so these are given as the
// convex pieces that runs make of them. Bits that keep geoms apart are set again when the model is
// compiled, while contacts are switched off, as nothing has to respond to them.
#include "tenon/engines/mujoco/overlap/penetrations.h"

#include <algorithm>
#include <map>
#include <utility>

#include "tenon/engines/mujoco/build/build.h"
#include "tenon/engines/mujoco/build/mesh_pieces.h"
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/start_pairs.h"

namespace tenon::engines::mujoco {

struct Penetrations::Parts {
  SharedModel model;
  DataPtr data;
  std::vector<int> free_qpos;          // (body_count)
  std::vector<Pose> engine_frames;     // X_BE (body_count)
  std::vector<int> collider_of_geom;   // (geom_count), -1: of none
  std::vector<scene::Index> scene_of;  // (collider_count)
  std::vector<NotMapped> not_mapped;
};

namespace {

using scene::Collider;
using scene::Index;
using scene::PhysicsScene;
using scene::ShapeKind;

/// Where collider `collider` is in the world at the start.
Pose world_pose(const PhysicsScene& scene, const Collider& collider) {
  return collider.body ? scene.bodies[*collider.body].pose * collider.pose : collider.pose;
}

bool is_on_kinematic(const PhysicsScene& scene, const Collider& collider) {
  return collider.body && scene.bodies[*collider.body].kinematic;
}

/// The triangles that a body has in runs where it is kinematic, as pieces of a hull.
void take_triangles(const PhysicsScene& scene, Collider& collider, PhysicsScene& bare) {
  const Vec3d up = -rotate(conjugate(world_pose(scene, collider).orientation),
                           scene.scenes[collider.scene].gravity);
  const MeshPieces pieces = triangle_pieces(scene.meshes[collider.shape.mesh], up);
  collider.shape.kind = ShapeKind::ConvexHull;
  for (const std::vector<Vec3d>& hull : pieces.hulls) {
    collider.shape.pieces.push_back(static_cast<Index>(bare.meshes.size()));
    scene::TriangleMesh piece;
    piece.points = hull;
    bare.meshes.push_back(std::move(piece));
  }
}

Collider bare_collider(const PhysicsScene& scene, const Collider& from, StaticColliders statics,
                       PhysicsScene& bare) {
  Collider collider;
  collider.path = from.path;
  collider.body = from.body;
  collider.scene = from.scene;
  collider.shape = from.shape;
  collider.pose = from.pose;
  collider.max_hull_vertices = from.max_hull_vertices;
  const bool counts = from.body || statics == StaticColliders::Included;
  collider.enabled = from.enabled && !from.settings.trigger && counts;
  if (!collider.enabled || !is_on_kinematic(scene, from)) {
    return collider;
  }
  if (from.shape.kind == ShapeKind::Mesh) {
    take_triangles(scene, collider, bare);
  } else if (from.shape.kind == ShapeKind::Plane) {  // which only the world can have
    collider.pose = world_pose(scene, from);
    collider.body.reset();
  }
  return collider;
}

/// The bodies and shapes of `scene`, and nothing that keeps them apart or together.
PhysicsScene bare_scene(const PhysicsScene& scene, StaticColliders statics) {
  PhysicsScene bare;
  for (const scene::Scene& from : scene.scenes) {
    scene::Scene one;
    one.path = from.path;
    one.gravity = from.gravity;
    bare.scenes.push_back(std::move(one));
  }
  if (!bare.scenes.empty()) {
    scene::VendorSetting no_contacts;
    no_contacts.name = "flag:contact";
    no_contacts.numbers = {0};
    bare.scenes.front().parts.mujoco.emplace();
    bare.scenes.front().parts.mujoco->push_back(std::move(no_contacts));
  }
  for (const scene::Body& from : scene.bodies) {
    scene::Body body;
    body.path = from.path;
    body.pose = from.pose;
    bare.bodies.push_back(std::move(body));
  }
  bare.meshes = scene.meshes;
  for (const Collider& from : scene.colliders) {
    bare.colliders.push_back(bare_collider(scene, from, statics, bare));
  }
  bare.up = scene.up;
  return bare;
}

/// All shapes may meet, at no distance.
void remove_filters(const std::vector<int>& collider_of_geom, mjModel& model) {
  model.opt.disableflags &= ~static_cast<int>(mjDSBL_CONTACT);
  // One contact of two hulls tells how deep they are.
  model.opt.disableflags |= mjDSBL_FILTERPARENT | mjDSBL_MULTICCD;
  for (int geom = 0; geom < model.ngeom; ++geom) {
    const int bits = collider_of_geom[static_cast<std::size_t>(geom)] < 0 ? 0 : 1;
    model.geom_contype[geom] = bits;
    model.geom_conaffinity[geom] = bits;
    model.geom_margin[geom] = 0;
    model.geom_gap[geom] = 0;
  }
}

Error no_room() {
  return Error(ErrorCode::Limit,
               "so many shapes meet that MuJoCo has no room for all of their contacts")
      .with_rule("mujoco.contacts-full")
      .with_fix("look at an asset of fewer bodies, or move apart what lies in one place");
}

Result<DataPtr> make_data(mjModel* model) {
  mjData* data = nullptr;
  TENON_CHECK(guarded([&] { data = mj_makeData(model); }));
  if (data == nullptr) {
    return no_room();
  }
  return DataPtr(data);
}

/// A point of the frame of a geom in the world.
Vec3d placed_point(const mjData& data, int geom, const float* point) {
  Vec3d placed = read_vector(data.geom_xpos + static_cast<std::ptrdiff_t>(3) * geom);
  const double* rows = data.geom_xmat + static_cast<std::ptrdiff_t>(9) * geom;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      placed[i] += rows[3 * i + j] * static_cast<double>(point[j]);
    }
  }
  return placed;
}

/// The hull that MuJoCo made of the points of a mesh: its graph is the counts of corners and faces,
/// a place in the list of neighbours for each corner, the corners' numbers among the points, that
/// list, and three points for each face. In the world.
scene::TriangleMesh hull_surface(const mjModel& model, const mjData& data, int geom) {
  scene::TriangleMesh surface;
  const int mesh = model.geom_dataid[geom];
  const int graph_at = model.mesh_graphadr[mesh];
  const float* points = model.mesh_vert + static_cast<std::ptrdiff_t>(3) * model.mesh_vertadr[mesh];
  if (graph_at < 0) {
    return surface;
  }
  const int* graph = model.mesh_graph + graph_at;
  const int corners = graph[0];
  const int faces = graph[1];
  std::map<int, int> number;
  for (int i = 0; i < corners; ++i) {
    const int point = graph[2 + corners + i];
    number[point] = i;
    surface.points.push_back(
        placed_point(data, geom, points + static_cast<std::ptrdiff_t>(3) * point));
  }
  const int* face = graph + (2 + 3 * (static_cast<std::ptrdiff_t>(corners) + faces));
  for (int i = 0; i < faces; ++i, face += 3) {
    surface.triangles.push_back({{number[face[0]], number[face[1]], number[face[2]]}});
  }
  return surface;
}

/// Each pair once, as deep as its deepest contact.
void keep_deepest(std::vector<Penetration>& found) {
  std::sort(found.begin(), found.end(), [](const Penetration& x, const Penetration& y) {
    return std::pair(x.a, x.b) != std::pair(y.a, y.b) ? std::pair(x.a, x.b) < std::pair(y.a, y.b)
                                                      : x.depth > y.depth;
  });
  const auto end = std::unique(
      found.begin(), found.end(),
      [](const Penetration& x, const Penetration& y) { return x.a == y.a && x.b == y.b; });
  found.erase(end, found.end());
}

}  // namespace

Penetrations::Penetrations(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Penetrations::Penetrations(Penetrations&&) noexcept = default;
Penetrations& Penetrations::operator=(Penetrations&&) noexcept = default;
Penetrations::~Penetrations() = default;

Result<Penetrations> Penetrations::make(const PhysicsScene& scene, StaticColliders statics,
                                        Diagnostics& diagnostics) {
  const PhysicsScene bare = bare_scene(scene, statics);
  TENON_CHECK(check_start_pairs(bare));
  Diagnostics findings;
  TENON_TRY(Model model, build_model(bare, {}, findings));
  for (const Diagnostic& found : findings) {
    if (found.rule == "mujoco.part-left-out") {
      diagnostics.add(found);
    }
  }
  remove_filters(model.collider_of_geom, own_model(model));
  auto parts = std::make_unique<Parts>();
  for (const BodyMap& body : model.bodies) {
    parts->free_qpos.push_back(body.free_qpos);
    parts->engine_frames.push_back(body.engine_frame);
  }
  for (const Collider& collider : scene.colliders) {
    parts->scene_of.push_back(collider.body ? scene.bodies[*collider.body].scene : collider.scene);
  }
  parts->collider_of_geom = std::move(model.collider_of_geom);
  parts->not_mapped = std::move(model.not_mapped);
  parts->data = std::move(model.data);
  parts->model = std::move(model.model);
  return Penetrations(std::move(parts));
}

Result<Penetrations> Penetrations::another() const {
  auto parts = std::make_unique<Parts>();
  parts->model = parts_->model;
  TENON_TRY(parts->data, make_data(parts_->model.get()));
  parts->free_qpos = parts_->free_qpos;
  parts->engine_frames = parts_->engine_frames;
  parts->collider_of_geom = parts_->collider_of_geom;
  parts->scene_of = parts_->scene_of;
  parts->not_mapped = parts_->not_mapped;
  return Penetrations(std::move(parts));
}

void Penetrations::place(const std::vector<Pose>& poses) {
  double* qpos = parts_->data->qpos;
  for (std::size_t b = 0; b < parts_->free_qpos.size(); ++b) {
    const Pose pose = poses[b] * parts_->engine_frames[b];
    write_vector(qpos + parts_->free_qpos[b], pose.position);
    write_quaternion(qpos + parts_->free_qpos[b] + 3, pose.orientation);
  }
}

Result<std::vector<Penetration>> Penetrations::at(const std::vector<Pose>& poses) {
  const mjModel* m = parts_->model.get();
  mjData* d = parts_->data.get();
  place(poses);
  d->warning[mjWARN_CONTACTFULL].number = 0;
  const Result<void> looked = guarded_where_open([&] {
    mj_kinematics(m, d);
    mj_collision(m, d);
  });
  if (!looked && looked.error().message().find("out of memory") == std::string::npos) {
    return looked.error();
  }
  if (!looked || d->warning[mjWARN_CONTACTFULL].number > 0) {
    return no_room();
  }
  std::vector<Penetration> found;
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    const int a = parts_->collider_of_geom[static_cast<std::size_t>(contact.geom[0])];
    const int b = parts_->collider_of_geom[static_cast<std::size_t>(contact.geom[1])];
    if (a < 0 || b < 0 || !(contact.dist < 0)) {
      continue;
    }
    const auto [first, second] = std::minmax({static_cast<Index>(a), static_cast<Index>(b)});
    if (parts_->scene_of[first] == parts_->scene_of[second]) {
      found.push_back({first, second, -contact.dist});
    }
  }
  keep_deepest(found);
  return found;
}

std::vector<UsedShape> Penetrations::used_shapes(const PhysicsScene& scene) {
  const mjModel& m = *parts_->model;
  mjData& d = *parts_->data;
  std::vector<Pose> start;
  for (const scene::Body& body : scene.bodies) {
    start.push_back(body.pose);
  }
  std::vector<UsedShape> used(scene.colliders.size());
  place(start);
  mj_kinematics(&m, &d);
  for (int geom = 0; geom < m.ngeom; ++geom) {
    const int collider = parts_->collider_of_geom[static_cast<std::size_t>(geom)];
    if (collider < 0) {
      continue;
    }
    const auto index = static_cast<std::size_t>(collider);
    if (m.geom_type[geom] != mjGEOM_MESH) {
      used[index].kind = UsedShape::Kind::Shape;
      continue;
    }
    scene::TriangleMesh surface = hull_surface(m, d, geom);
    const Pose to_collider = inverse(world_pose(scene, scene.colliders[index]));
    for (Vec3d& point : surface.points) {
      point = transform_point(to_collider, point);
    }
    used[index].kind = UsedShape::Kind::Hulls;
    used[index].surfaces.push_back(std::move(surface));
  }
  for (const NotMapped& note : parts_->not_mapped) {
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (scene.colliders[i].path == note.prim) {
        used[i].notes.push_back(note.why);
      }
    }
  }
  return used;
}

const std::vector<NotMapped>& Penetrations::not_mapped() const { return parts_->not_mapped; }

}  // namespace tenon::engines::mujoco
