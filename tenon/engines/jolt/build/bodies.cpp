// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Every collider that stands still is a body of its own, which the asset moves where it has samples
// of it. A body without colliders gets a small ball that nothing meets, as Jolt has no body without
// a shape.
#include <algorithm>

#include "tenon/engines/jolt/build/shapes.h"
#include "tenon/engines/scene_timeline.h"
#include "tenon/math/inertia.h"
//
#include <Jolt/Physics/Collision/Shape/SphereShape.h>

namespace tenon::engines::jolt {
namespace {

using scene::Index;

constexpr JPH::ObjectLayer kMovingLayer = 0;
constexpr JPH::ObjectLayer kStillLayer = 1;

// Jolt has bits for axes of the world that a body may use: 1 x, 2 y, 4 z, then for turns.
JPH::EAllowedDOFs freedom_of(const scene::BodySettings& settings) {
  const int locked = settings.locked_translation | (settings.locked_rotation << 3);
  return static_cast<JPH::EAllowedDOFs>(0b111111 & ~locked);
}

JPH::BodyCreationSettings body_settings(const scene::Body& body, const BodyState& state,
                                        const JPH::Shape* shape) {
  JPH::BodyCreationSettings wanted(
      shape, to_jolt_place(state.pose.position), to_jolt(state.pose.orientation),
      body.kinematic ? JPH::EMotionType::Kinematic : JPH::EMotionType::Dynamic, kMovingLayer);
  wanted.mLinearVelocity = to_jolt(body.kinematic ? Vec3d{} : state.linear_velocity);
  wanted.mAngularVelocity = to_jolt(body.kinematic ? Vec3d{} : state.angular_velocity);
  wanted.mAllowedDOFs = body.kinematic ? JPH::EAllowedDOFs::All : freedom_of(body.settings);
  wanted.mCollideKinematicVsNonDynamic = body.kinematic;
  wanted.mApplyGyroscopicForce = body.settings.gyroscopic;
  wanted.mAllowSleeping = false;
  wanted.mLinearDamping = to_jolt(body.linear_damping);
  wanted.mAngularDamping = to_jolt(body.angular_damping);
  constexpr double kMostSpeed = 1e15;  // its square is a number of single precision
  wanted.mMaxLinearVelocity = to_jolt(std::min(body.settings.max_linear_velocity, kMostSpeed));
  wanted.mMaxAngularVelocity = to_jolt(std::min(body.settings.max_angular_velocity, kMostSpeed));
  wanted.mGravityFactor = to_jolt(body.gravity_scale);
  wanted.mOverrideMassProperties = JPH::EOverrideMassProperties::MassAndInertiaProvided;
  wanted.mMassPropertiesOverride.mMass = 1;
  wanted.mMassPropertiesOverride.mInertia = JPH::Mat44::sIdentity();
  return wanted;
}

bool moves_by_track(const scene::PhysicsScene& scene, Index collider) {
  return std::any_of(scene.pose_tracks.begin(), scene.pose_tracks.end(),
                     [&](const scene::PoseTrack& track) { return track.collider == collider; });
}

Result<JPH::Body*> add_body(Build& build, Index scene, const JPH::BodyCreationSettings& wanted,
                            const Path& path) {
  JPH::BodyInterface& bodies = build.model.systems[scene].system->GetBodyInterfaceNoLock();
  JPH::Body* made = bodies.CreateBody(wanted);
  if (made == nullptr) {
    return Error(ErrorCode::Invalid, "Jolt makes no body of this one")
        .with_rule("jolt.refused")
        .with_prim(path.str());
  }
  return made;
}

Result<void> add_static_body(Build& build, Index index, const BodyFilter& filter) {
  const scene::Collider& collider = build.scene.colliders[index];
  const JPH::RefConst<JPH::Shape> shape = joined_shape(shapes_of(build, index, false), {});
  if (shape == nullptr) {
    return {};
  }
  const bool moves = moves_by_track(build.scene, index);
  JPH::BodyCreationSettings wanted(shape, to_jolt_place(collider.pose.position),
                                   to_jolt(collider.pose.orientation),
                                   moves ? JPH::EMotionType::Kinematic : JPH::EMotionType::Static,
                                   moves ? kMovingLayer : kStillLayer);
  wanted.mCollisionGroup = filter.group_of_collider(index);
  wanted.mUseManifoldReduction = collider.face_materials.empty();
  wanted.mAllowSleeping = false;
  wanted.mOverrideMassProperties = JPH::EOverrideMassProperties::MassAndInertiaProvided;
  wanted.mMassPropertiesOverride.mMass = 1;
  wanted.mMassPropertiesOverride.mInertia = JPH::Mat44::sIdentity();
  TENON_TRY(build.model.static_bodies[index],
            add_body(build, collider.scene, wanted, collider.path));
  return {};
}

Result<void> add_moving_body(Build& build, Index index, const BodyFilter& filter,
                             const std::vector<Index>& colliders) {
  const scene::Body& body = build.scene.bodies[index];
  std::vector<PlacedShape> parts;
  for (const Index c : colliders) {
    for (const PlacedShape& part : shapes_of(build, c, !body.kinematic)) {
      parts.push_back({part.shape, build.scene.colliders[c].pose * part.pose});
    }
  }
  const bool empty = parts.empty();
  if (empty) {
    parts.push_back({new JPH::SphereShape(1e-3F), {}});
  }
  JPH::BodyCreationSettings wanted =
      body_settings(body, build.states[index], joined_shape(parts, body.center_of_mass));
  wanted.mUserData = number_of(index);
  if (wanted.GetShape() == nullptr) {
    return Error(ErrorCode::Invalid, "Jolt makes no shape of the colliders of this body")
        .with_rule("jolt.refused")
        .with_prim(body.path.str());
  }
  wanted.mCollisionGroup = filter.group_of_body(index);
  // Contacts of several colliders stay apart: each has a surface of its own.
  wanted.mUseManifoldReduction = colliders.size() <= 1;
  TENON_TRY(JPH::Body * made, add_body(build, body.scene, wanted, body.path));
  build.model.bodies[index] = made;
  if (!body.kinematic) {
    set_mass(body, *made);
  }
  return {};
}

std::vector<std::vector<Index>> colliders_by_body(const scene::PhysicsScene& scene) {
  std::vector<std::vector<Index>> colliders(scene.bodies.size());
  for (Index c = 0; c < scene.colliders.size(); ++c) {
    if (scene.colliders[c].enabled && scene.colliders[c].body.has_value()) {
      colliders[*scene.colliders[c].body].push_back(c);
    }
  }
  return colliders;
}

// Together, for a tree of bounds that is balanced from the start.
void add_to_system(Build& build, Index scene, std::vector<JPH::BodyID>& ids,
                   JPH::EActivation activation) {
  if (ids.empty()) {
    return;
  }
  JPH::BodyInterface& bodies = build.model.systems[scene].system->GetBodyInterfaceNoLock();
  const auto count = static_cast<int>(ids.size());
  const JPH::BodyInterface::AddState state = bodies.AddBodiesPrepare(ids.data(), count);
  bodies.AddBodiesFinalize(ids.data(), count, state, activation);
}

void put_into_systems(Build& build, Begin begin) {
  for (Index s = 0; s < build.scene.scenes.size(); ++s) {
    std::vector<JPH::BodyID> still;
    std::vector<JPH::BodyID> awake;
    std::vector<JPH::BodyID> asleep;
    for (Index c = 0; c < build.model.static_bodies.size(); ++c) {
      const JPH::Body* body = build.model.static_bodies[c];
      if (body != nullptr && build.scene.colliders[c].scene == s) {
        (body->IsStatic() ? still : awake).push_back(body->GetID());
      }
    }
    for (Index b = 0; b < build.model.bodies.size(); ++b) {
      const scene::Body& source = build.scene.bodies[b];
      if (source.scene == s) {
        const bool sleeps = begin == Begin::Start && source.starts_asleep && !source.kinematic;
        (sleeps ? asleep : awake).push_back(build.model.bodies[b]->GetID());
      }
    }
    add_to_system(build, s, still, JPH::EActivation::DontActivate);
    add_to_system(build, s, asleep, JPH::EActivation::DontActivate);
    add_to_system(build, s, awake, JPH::EActivation::Activate);
  }
}

}  // namespace

void set_mass(const scene::Body& body, JPH::Body& made) {
  JPH::MotionProperties& motion = *made.GetMotionProperties();
  const PrincipalInertia principal = principal_inertia(body.inertia);
  Vec3d inverse;
  for (std::size_t i = 0; i < 3; ++i) {
    inverse[i] = 1 / std::max(principal.moments[i], kMinMoment);
  }
  const bool slides = body.settings.locked_translation != 7;
  const bool turns = body.settings.locked_rotation != 7;
  motion.SetInverseMass(slides ? to_jolt(1 / std::max(body.mass, kMinMass)) : 0);
  motion.SetInverseInertia(turns ? to_jolt(inverse) : JPH::Vec3::sZero(), to_jolt(principal.axes));
}

Result<void> add_bodies(Build& build, Begin begin) {
  build.model.bodies.assign(build.scene.bodies.size(), nullptr);
  build.model.static_bodies.assign(build.scene.colliders.size(), nullptr);
  const JPH::Ref<BodyFilter> filter = new BodyFilter(build.scene);
  for (Index c = 0; c < build.scene.colliders.size(); ++c) {
    if (build.scene.colliders[c].enabled && !build.scene.colliders[c].body.has_value()) {
      TENON_CHECK(add_static_body(build, c, *filter));
    }
  }
  const std::vector<std::vector<Index>> colliders = colliders_by_body(build.scene);
  for (Index b = 0; b < build.scene.bodies.size(); ++b) {
    TENON_CHECK(add_moving_body(build, b, *filter, colliders[b]));
  }
  put_into_systems(build, begin);
  return {};
}

}  // namespace tenon::engines::jolt
