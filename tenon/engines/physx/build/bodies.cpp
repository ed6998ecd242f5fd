// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A body with a joint of a tree above or below it is a link; the others stand alone. A tree that
// hangs on the world by a joint with a coordinate gets a link of no size there, which the scene
// does not have. PhysX takes 0 for an infinite mass, so nothing gets less than the least.
#include <algorithm>
#include <cmath>

#include "tenon/engines/physx/build/settings.h"
#include "tenon/engines/scene_timeline.h"
#include "tenon/math/inertia.h"

namespace tenon::engines::physx {
namespace {

using scene::Index;

float speed_bound(double bound) {
  return static_cast<float>(std::min(bound, static_cast<double>(kNoBound)));
}

// PhysX locks axes of the world on bodies that stand alone.
px::PxRigidDynamicLockFlags locks_of(const scene::BodySettings& settings) {
  return px::PxRigidDynamicLockFlags(static_cast<px::PxU8>(settings.locked_translation) |
                                     static_cast<px::PxU8>(settings.locked_rotation << 3));
}

px::PxRigidDynamic* make_free_body(Build& build, Index index) {
  const scene::Body& body = build.scene.bodies[index];
  px::PxRigidDynamic* made =
      build.model.owned.add(build.runtime.physics->createRigidDynamic(to_px(body.pose)));
  if (made == nullptr) {
    return nullptr;
  }
  set_mass(body, *made);
  made->setRigidBodyFlag(px::PxRigidBodyFlag::eKINEMATIC, body.kinematic);
  set_body_settings(build, index, *made);
  made->setRigidDynamicLockFlags(locks_of(body.settings));
  return made;
}

/// The tree of each body that is a link (body_count).
using Trees = std::vector<std::size_t>;

std::size_t new_tree(Build& build, Index body, bool fixed) {
  px::PxArticulationReducedCoordinate* made =
      build.model.owned.add(build.runtime.physics->createArticulationReducedCoordinate());
  made->setArticulationFlag(px::PxArticulationFlag::eFIX_BASE, fixed);
  made->setArticulationFlag(px::PxArticulationFlag::eDRIVE_LIMITS_ARE_FORCES, true);
  const scene::Articulation* source = articulation_of(build, body);
  const Settings settings = source == nullptr ? Settings() : source->parts.physx;
  const Index scene = build.scene.bodies[body].scene;
  const Iterations iterations = iterations_of(build, scene, settings, kTreeIterations);
  made->setSolverIterationCounts(iterations.positions, iterations.velocities);
  made->setSleepThreshold(sleep_threshold_of(build, scene, settings));
  made->setStabilizationThreshold(
      to_px(std::max(number_of(settings, "stabilizationThreshold").value_or(0), 0.0)));
  made->setMaxCOMLinearVelocity(kNoBound);
  made->setMaxCOMAngularVelocity(kNoBound);
  build.model.trees.push_back({made, nullptr, build.scene.bodies[body].scene});
  return build.model.trees.size() - 1;
}

px::PxArticulationLink* new_link(Build& build, std::size_t tree, px::PxArticulationLink* parent,
                                 Index body) {
  px::PxArticulationLink* link = build.model.trees[tree].articulation->createLink(
      parent, to_px(build.scene.bodies[body].pose));
  if (link != nullptr) {
    set_mass(build.scene.bodies[body], *link);
    set_body_settings(build, body, *link);
    build.model.bodies[body] = link;
  }
  return link;
}

px::PxArticulationLink* link_of(const Build& build, Index body) {
  return static_cast<px::PxArticulationLink*>(build.model.bodies[body]);
}

/// The link of no size that a tree hangs on: its mass is never moved.
px::PxArticulationLink* new_anchor(Build& build, std::size_t tree, const Pose& pose) {
  px::PxArticulationLink* anchor =
      build.model.trees[tree].articulation->createLink(nullptr, to_px(pose));
  if (anchor != nullptr) {
    anchor->setMass(1);
    anchor->setMassSpaceInertiaTensor(px::PxVec3(1, 1, 1));
  }
  return anchor;
}

void add_link(Build& build, Index body, Trees& trees) {
  const scene::ForestBody& place = build.forest.bodies[body];
  const JointMap* map = place.joint ? &build.model.joints[*place.joint] : nullptr;
  if (map != nullptr && map->role == JointRole::Root) {
    trees[body] = new_tree(build, body, true);
    new_link(build, trees[body], nullptr, body);
    return;
  }
  if (map == nullptr || map->role != JointRole::Reduced) {  // it floats, others hang on it
    trees[body] = new_tree(build, body, false);
    new_link(build, trees[body], nullptr, body);
    return;
  }
  JointMap& joint = build.model.joints[*place.joint];
  px::PxArticulationLink* parent = nullptr;
  if (place.parent.has_value()) {
    trees[body] = trees[*place.parent];
    parent = link_of(build, *place.parent);
  } else {
    trees[body] = new_tree(build, body, true);
    const scene::Joint& source = build.scene.joints[*place.joint];
    parent = new_anchor(build, trees[body], joint.reversed ? source.frame1 : source.frame0);
  }
  px::PxArticulationLink* link = new_link(build, trees[body], parent, body);
  joint.tree = trees[body];
  joint.link_joint = link == nullptr ? nullptr : link->getInboundJoint();
}

/// Links of trees: bodies that a reduced joint has above or below, or that one fixes to the world.
std::vector<char> links_of(const Build& build) {
  std::vector<char> is_link(build.scene.bodies.size(), 0);
  for (Index b = 0; b < build.forest.bodies.size(); ++b) {
    const scene::ForestBody& place = build.forest.bodies[b];
    if (!place.joint.has_value()) {
      continue;
    }
    const JointRole role = build.model.joints[*place.joint].role;
    if (role == JointRole::Reduced || role == JointRole::Root) {
      is_link[b] = 1;
      if (place.parent.has_value()) {
        is_link[*place.parent] = 1;
      }
    }
  }
  return is_link;
}

}  // namespace

void set_mass(const scene::Body& body, px::PxRigidBody& made) {
  const PrincipalInertia principal = principal_inertia(body.inertia);
  px::PxVec3 moments;
  for (px::PxU32 i = 0; i < 3; ++i) {
    moments[i] = to_px(std::max(principal.moments[i], kMinMoment));
  }
  made.setMass(to_px(std::max(body.mass, kMinMass)));
  made.setMassSpaceInertiaTensor(moments);
  made.setCMassLocalPose(to_px(Pose{body.center_of_mass, principal.axes}));
  made.setLinearDamping(to_px(body.linear_damping));
  made.setAngularDamping(to_px(body.angular_damping));
  made.setMaxLinearVelocity(speed_bound(body.settings.max_linear_velocity));
  made.setMaxAngularVelocity(speed_bound(body.settings.max_angular_velocity));
  made.setRigidBodyFlag(px::PxRigidBodyFlag::eENABLE_GYROSCOPIC_FORCES, body.settings.gyroscopic);
  made.setActorFlag(px::PxActorFlag::eDISABLE_GRAVITY, body.gravity_scale == 0);
}

Result<void> add_bodies(Build& build) {
  build.model.bodies.assign(build.scene.bodies.size(), nullptr);
  const std::vector<char> is_link = links_of(build);
  Trees trees(build.scene.bodies.size(), 0);
  for (const Index body : build.forest.order) {
    if (is_link[body] != 0) {
      add_link(build, body, trees);
    } else {
      build.model.bodies[body] = make_free_body(build, body);
    }
    if (build.model.bodies[body] == nullptr) {
      return Error(ErrorCode::Invalid, "PhysX makes no body of this one")
          .with_rule("physx.refused")
          .with_prim(build.scene.bodies[body].path.str());
    }
    build.model.bodies[body]->userData = number_of(body);
  }
  return {};
}

}  // namespace tenon::engines::physx
