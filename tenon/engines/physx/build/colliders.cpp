// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Colliders become shapes of their body's actor; static ones have an actor each, which the asset
// moves where it has samples of it. Contacts are looked for within half of the smallest size of a
// shape, 2 mm at most: a contact that is made before the surfaces meet takes a part of the speed
// that is to come back by restitution (at 5 m/s and PhysX's own 20 mm a fifth of it).
#include <algorithm>

#include "tenon/engines/physx/build/geometry.h"

namespace tenon::engines::physx {
namespace {

using scene::Collider;
using scene::Index;

constexpr double kMostOffset = 0.002;    // [m]
constexpr double kLeastOffset = 0.0001;  // [m]

std::vector<px::PxMaterial*> materials_of(const Build& build, const Collider& collider) {
  const auto made = [&](const std::optional<Index>& material) {
    return build.materials[material.value_or(static_cast<Index>(build.materials.size() - 1))];
  };
  std::vector<px::PxMaterial*> materials{made(collider.material)};
  if (collider.shape.kind == scene::ShapeKind::Mesh) {
    for (const scene::FaceMaterial& face : collider.face_materials) {
      materials.push_back(made(face.material));
    }
  }
  return materials;
}

double smallest_half(const std::vector<Vec3d>& points) {
  Vec3d low{{kInfinity, kInfinity, kInfinity}};
  Vec3d high = -low;
  for (const Vec3d& point : points) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], point[i]);
      high[i] = std::max(high[i], point[i]);
    }
  }
  const Vec3d half = (high - low) * 0.5;
  return std::min({half[0], half[1], half[2]});
}

double smallest_half(const scene::PhysicsScene& scene, const scene::Shape& shape) {
  switch (shape.kind) {
    case scene::ShapeKind::Box:
    case scene::ShapeKind::Ellipsoid:
      return std::min({shape.half_extents[0], shape.half_extents[1], shape.half_extents[2]});
    case scene::ShapeKind::Sphere:
    case scene::ShapeKind::Capsule:
      return shape.radius;
    case scene::ShapeKind::Cylinder:
    case scene::ShapeKind::Cone:
      return std::min(shape.radius, shape.half_height);
    case scene::ShapeKind::Plane:
      return kInfinity;
    case scene::ShapeKind::ConvexHull:
    case scene::ShapeKind::Mesh:
      return smallest_half(scene.meshes[shape.mesh].points);
    case scene::ShapeKind::Spheres:
      break;
  }
  const auto smallest = std::min_element(shape.sphere_radii.begin(), shape.sphere_radii.end());
  return smallest == shape.sphere_radii.end() ? 0 : *smallest;
}

void set_offsets(const scene::PhysicsScene& scene, const Collider& collider, px::PxShape& shape) {
  const double rest = collider.rest_offset.value_or(0);
  const double usual =
      std::clamp(smallest_half(scene, collider.shape) / 2, kLeastOffset, kMostOffset);
  shape.setContactOffset(to_px(std::max(collider.contact_offset.value_or(usual), rest + 1e-5)));
  shape.setRestOffset(to_px(rest));
}

px::PxShapeFlags flags_of(const Collider& collider) {
  return collider.settings.trigger ? px::PxShapeFlag::eTRIGGER_SHAPE
                                   : px::PxShapeFlag::eSIMULATION_SHAPE;
}

bool moves_by_track(const scene::PhysicsScene& scene, Index collider) {
  return std::any_of(scene.pose_tracks.begin(), scene.pose_tracks.end(),
                     [&](const scene::PoseTrack& track) { return track.collider == collider; });
}

px::PxRigidActor* make_static_actor(Build& build, Index index) {
  px::PxPhysics& physics = *build.runtime.physics;
  const px::PxTransform pose = to_px(build.scene.colliders[index].pose);
  if (!moves_by_track(build.scene, index)) {
    return build.model.owned.add(physics.createRigidStatic(pose));
  }
  px::PxRigidDynamic* moved = build.model.owned.add(physics.createRigidDynamic(pose));
  moved->setRigidBodyFlag(px::PxRigidBodyFlag::eKINEMATIC, true);
  return moved;
}

void add_shapes(Build& build, Index index, px::PxRigidActor& actor) {
  const Collider& collider = build.scene.colliders[index];
  const bool moves = build.scene.is_dynamic(collider.body);
  const Pose local = collider.body.has_value() ? collider.pose : Pose{};
  std::vector<px::PxMaterial*> materials = materials_of(build, collider);
  for (const Geometry& geometry : geometry_of(build, collider, moves)) {
    px::PxShape* shape = build.runtime.physics->createShape(
        geometry.shape.any(), materials.data(), static_cast<px::PxU16>(materials.size()), true,
        flags_of(collider));
    if (shape == nullptr) {
      build.report(collider.path, "", "PhysX refuses the shape");
      continue;
    }
    shape->setLocalPose(to_px(local * geometry.pose));
    shape->setSimulationFilterData(px::PxFilterData(index, 0, 0, 0));
    set_offsets(build.scene, collider, *shape);
    shape->setTorsionalPatchRadius(to_px(collider.settings.torsional_patch));
    shape->setMinTorsionalPatchRadius(to_px(collider.settings.min_torsional_patch));
    actor.attachShape(*shape);
    shape->release();  // the actor keeps it
    build.model.shapes[index].push_back(shape);
  }
}

}  // namespace

void add_colliders(Build& build) {
  build.model.shapes.resize(build.scene.colliders.size());
  build.model.static_actors.assign(build.scene.colliders.size(), nullptr);
  for (Index c = 0; c < build.scene.colliders.size(); ++c) {
    const Collider& collider = build.scene.colliders[c];
    if (!collider.enabled) {
      continue;
    }
    px::PxRigidActor* actor = nullptr;
    if (collider.body.has_value()) {
      actor = build.model.bodies[*collider.body];
    } else {
      actor = build.model.static_actors[c] = make_static_actor(build, c);
    }
    add_shapes(build, c, *actor);
  }
}

}  // namespace tenon::engines::physx
