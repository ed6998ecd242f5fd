// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/physx/run/read_state.h"

#include "tenon/engines/joint_readings.h"
#include "tenon/engines/physx/convert.h"

namespace tenon::engines::physx {
namespace {

using scene::Index;

RigidMotion motion_of(const Model& model, const std::optional<Index>& body) {
  if (!body.has_value()) {
    return {};
  }
  const px::PxRigidBody& actor = *model.bodies[*body];
  return {read_center_of_mass(model, *body), from_px(actor.getLinearVelocity()),
          from_px(actor.getAngularVelocity())};
}

JointSide side_of(const Model& model, const std::optional<Index>& body, const Pose& frame) {
  const Pose pose = body ? from_px(model.bodies[*body]->getGlobalPose()) * frame : frame;
  return {pose, motion_of(model, body)};
}

double kinetic(const px::PxRigidBody& actor) {
  const Vec3d linear = from_px(actor.getLinearVelocity());
  const px::PxQuat axes = actor.getGlobalPose().q * actor.getCMassLocalPose().q;
  const Vec3d turn = from_px(axes.rotateInv(actor.getAngularVelocity()));
  const Vec3d moments = from_px(actor.getMassSpaceInertiaTensor());
  double energy = static_cast<double>(actor.getMass()) * dot(linear, linear) / 2;
  for (std::size_t i = 0; i < 3; ++i) {
    energy += moments[i] * turn[i] * turn[i] / 2;
  }
  return energy;
}

}  // namespace

void read_caches(const Model& model) {
  px::PxArticulationCacheFlags flags = px::PxArticulationCacheFlag::ePOSITION;
  flags |= px::PxArticulationCacheFlag::eVELOCITY;
  for (const ReducedTree& tree : model.trees) {
    tree.articulation->copyInternalStateToCache(*tree.cache, flags);
  }
}

BodyState read_body_state(const Model& model, Index body) {
  const px::PxRigidBody& actor = *model.bodies[body];
  return {from_px(actor.getGlobalPose()), from_px(actor.getLinearVelocity()),
          from_px(actor.getAngularVelocity())};
}

JointState read_joint_state(const scene::PhysicsScene& scene, const Model& model, Index joint) {
  const JointMap& map = model.joints[joint];
  if (map.role == JointRole::Reduced && map.dofs.free.size() == 1) {
    const px::PxArticulationCache& cache = *model.trees[map.tree].cache;
    return {{static_cast<double>(cache.jointPosition[map.coordinate])},
            {static_cast<double>(cache.jointVelocity[map.coordinate])}};
  }
  const scene::Joint& source = scene.joints[joint];
  return joint_state_between(source, map.dofs, side_of(model, source.body0, source.frame0),
                             side_of(model, source.body1, source.frame1));
}

Vec3d read_center_of_mass(const Model& model, Index body) {
  const px::PxRigidBody& actor = *model.bodies[body];
  return from_px(actor.getGlobalPose().transform(actor.getCMassLocalPose().p));
}

Energy read_energy(const scene::PhysicsScene& scene, const Model& model,
                   std::span<const Vec3d> gravity) {
  Energy energy;
  for (Index b = 0; b < model.bodies.size(); ++b) {
    const scene::Body& body = scene.bodies[b];
    if (body.kinematic) {
      continue;
    }
    const px::PxRigidBody& actor = *model.bodies[b];
    energy.kinetic += kinetic(actor);
    const Vec3d pull = gravity[body.scene] * body.gravity_scale;
    energy.potential -=
        static_cast<double>(actor.getMass()) * dot(pull, read_center_of_mass(model, b));
  }
  for (Index j = 0; j < model.joints.size(); ++j) {
    const scene::Joint& joint = scene.joints[j];
    if (model.joints[j].role != JointRole::Reduced ||
        (joint.armature == 0 && joint.stiffness == 0)) {
      continue;
    }
    const JointState state = read_joint_state(scene, model, j);
    if (state.position.size() == 1) {
      const double stretch = state.position[0] - joint.spring_reference;
      energy.kinetic += joint.armature * state.velocity[0] * state.velocity[0] / 2;
      energy.potential += joint.stiffness * stretch * stretch / 2;
    }
  }
  return energy;
}

std::size_t read_contact_count(const Model& model) {
  std::size_t count = 0;
  for (px::PxScene* scene : model.scenes) {
    px::PxSimulationStatistics statistics;
    scene->getSimulationStatistics(statistics);
    count += statistics.nbDiscreteContactPairsWithContacts;
  }
  return count;
}

}  // namespace tenon::engines::physx
