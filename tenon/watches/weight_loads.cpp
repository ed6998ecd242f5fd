// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/watches/weight_loads.h"

#include "tenon/scene/joint_dofs.h"
#include "tenon/scene/joint_forest.h"

namespace tenon::watches {
namespace {

using scene::Index;

/// Sums over a body and all that hang on it.
struct Weight {
  Vec3d force;   ///< [N]
  Vec3d moment;  ///< about the origin of the world [N m]
};

std::vector<Weight> weights_of_subtrees(const engines::Simulation& simulation,
                                        const scene::PhysicsScene& scene,
                                        const scene::JointForest& forest) {
  std::vector<Weight> weights(scene.bodies.size());
  for (auto b = forest.order.rbegin(); b != forest.order.rend(); ++b) {
    const scene::Body& body = scene.bodies[*b];
    const Vec3d own = simulation.gravity(body.scene) * (body.mass * body.gravity_scale);
    Weight& weight = weights[*b];
    weight.force = weight.force + own;
    weight.moment = weight.moment + cross(simulation.center_of_mass(*b), own);
    if (const std::optional<Index> parent = forest.bodies[*b].parent) {
      weights[*parent].force = weights[*parent].force + weight.force;
      weights[*parent].moment = weights[*parent].moment + weight.moment;
    }
  }
  return weights;
}

}  // namespace

std::vector<double> weight_loads(const engines::Simulation& simulation,
                                 const scene::PhysicsScene& scene) {
  std::vector<double> loads(scene.joints.size(), 0);
  const scene::JointForest forest = joint_forest(scene);
  const std::vector<Weight> weights = weights_of_subtrees(simulation, scene, forest);
  for (Index b = 0; b < scene.bodies.size(); ++b) {
    const scene::ForestBody& node = forest.bodies[b];
    if (!node.joint || !node.fixed) {
      continue;
    }
    const scene::Joint& joint = scene.joints[*node.joint];
    const scene::JointDofs dofs = joint_dofs(joint);
    if (dofs.count() != 1 || dofs.free.size() != 1) {
      continue;
    }
    const Pose& frame = node.reversed ? joint.frame0 : joint.frame1;
    const Vec3d& own_axis = node.reversed ? dofs.free.front().axis0 : dofs.free.front().axis1;
    const Pose place = simulation.body_state(b).pose * frame;
    const Vec3d axis = rotate(place.orientation, own_axis);
    const Weight& weight = weights[b];
    const double along = is_angular(dofs.free.front().dof)
                             ? dot(axis, weight.moment - cross(place.position, weight.force))
                             : dot(axis, weight.force);
    loads[*node.joint] = node.reversed ? -along : along;
  }
  return loads;
}

}  // namespace tenon::watches
