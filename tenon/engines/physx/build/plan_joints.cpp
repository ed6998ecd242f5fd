// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Which joints become coordinates of a tree. A tree of PhysX has joints with one coordinate, balls
// without bounds, and joints that hold; everything else, and what may break, is a constraint
// between bodies. The trees are parts of the scene's own forest, so that loops are cut where every
// engine cuts them.
#include "tenon/engines/physx/build/build.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::engines::physx {
namespace {

using scene::Index;
using scene::Joint;

bool fits_a_tree(const Build& build, const Joint& joint, const scene::JointDofs& dofs) {
  const bool few = dofs.free.size() + (dofs.ball ? 1u : 0u) <= 1;
  return joint.articulation.has_value() && few && !can_break(joint) &&
         joint.kind != scene::JointKind::Distance && joint.limit_springs.empty() &&
         !(dofs.ball && !joint.drives.empty()) &&
         !(joint.body0 && build.scene.bodies[*joint.body0].kinematic) &&
         !(joint.body1 && build.scene.bodies[*joint.body1].kinematic);
}

bool acts(const Build& build, Index joint) {
  return build.forest.joints[joint] != scene::ForestRole::None ||
         build.scene.joints[joint].kind == scene::JointKind::Distance;
}

}  // namespace

void plan_joints(Build& build) {
  build.forest = joint_forest(build.scene);
  const std::vector<scene::FreeRotations> rotations = wanted_rotations(build.scene);
  build.model.joints.resize(build.scene.joints.size());
  for (Index j = 0; j < build.scene.joints.size(); ++j) {
    JointMap& map = build.model.joints[j];
    map.dofs = joint_dofs(build.scene.joints[j], rotations[j]);
    if (build.scene.joints[j].enabled && acts(build, j)) {
      map.role = JointRole::Maximal;
    }
  }
  for (const Index body : build.forest.order) {
    const scene::ForestBody& place = build.forest.bodies[body];
    if (!place.joint.has_value()) {
      continue;
    }
    const Joint& joint = build.scene.joints[*place.joint];
    JointMap& map = build.model.joints[*place.joint];
    if (map.role != JointRole::Maximal || !fits_a_tree(build, joint, map.dofs)) {
      continue;
    }
    map.reversed = place.reversed;
    const bool holds = map.dofs.free.empty() && !map.dofs.ball;
    map.role = !place.parent.has_value() && holds ? JointRole::Root : JointRole::Reduced;
  }
}

}  // namespace tenon::engines::physx
