// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/run/breaking.h"

#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::engines::mujoco {

Breaking::Breaking(const scene::PhysicsScene& scene, const Model& model) {
  bool any = false;
  for (const scene::Joint& joint : scene.joints) {
    any = any || (scene::can_break(joint) && joint.enabled);
  }
  if (!any) {
    return;
  }
  for (JointCarriers& carriers : find_carriers(scene, model)) {
    const scene::Joint& joint = scene.joints[carriers.joint];
    if (scene::can_break(joint) && joint.enabled) {
      breakable_.push_back(std::move(carriers));
    }
  }
}

Result<std::vector<Breaking::Broken>> Breaking::broken(const scene::PhysicsScene& scene,
                                                       const Model& model) const {
  TENON_CHECK(guarded([&] { mj_rnePostConstraint(model.model.get(), model.data.get()); }));
  std::vector<Broken> broken;
  for (const JointCarriers& carriers : breakable_) {
    const scene::Joint& joint = scene.joints[carriers.joint];
    const Wrench load = joint_reaction(scene, model, carriers);
    const double force = length(load.force);
    const double torque = length(load.torque);
    if (force > joint.break_force || torque > joint.break_torque) {
      broken.push_back({carriers.joint, force, torque});
    }
  }
  return broken;
}

}  // namespace tenon::engines::mujoco
