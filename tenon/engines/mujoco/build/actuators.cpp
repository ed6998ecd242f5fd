// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tenon/engines/mujoco/build/build.h"

// A drive is MuJoCo's PID actuator without the I: inputs position and velocity target, force
// k (x* - q) + d (v* - v) clamped as one to +-max_force (S-102). Gains of acceleration drives are
// multiplied by the effective inertia before each step (S-104), so here they stand unscaled.
namespace tenon::engines::mujoco {
namespace {

mjsActuator* add_drive(Build& build, const scene::Joint& joint, const scene::Drive& drive,
                       mjsJoint* target) {
  mjsActuator* actuator = mjs_addActuator(build.spec.get(), nullptr);
  const std::string name = joint.path.str() + ".drive." + std::string(dof_name(drive.dof));
  mjs_setName(actuator->element, name.c_str());
  actuator->trntype = mjTRN_JOINT;
  mjs_setString(actuator->target, mjs_getString(mjs_getName(target->element)));
  double damping = drive.damping;
  mjs_setToPID(actuator, drive.stiffness, &damping, nullptr, nullptr, nullptr, nullptr, 0,
               mjINPUT_POS | mjINPUT_VEL);
  actuator->forcelimited = drive.max_force < scene::kUnlimited ? mjLIMITED_TRUE : mjLIMITED_FALSE;
  if (drive.max_force < scene::kUnlimited) {
    actuator->forcerange[0] = -drive.max_force;
    actuator->forcerange[1] = drive.max_force;
  }
  actuator->ctrllimited = mjLIMITED_FALSE;
  return actuator;
}

bool is_animated(const scene::PhysicsScene& scene, scene::Index joint, std::size_t drive) {
  for (const scene::ScalarTrack& track : scene.scalar_tracks) {
    if (track.joint == joint && track.drive == drive) {
      return true;
    }
  }
  return false;
}

}  // namespace

void add_actuators(Build& build) {
  build.actuators.assign(build.scene.joints.size(), {});
  for (scene::Index j = 0; j < build.scene.joints.size(); ++j) {
    const scene::Joint& joint = build.scene.joints[j];
    for (std::size_t i = 0; i < joint.drives.size(); ++i) {
      const scene::Drive& drive = joint.drives[i];
      build.actuators[j].push_back(nullptr);
      const bool acts =
          drive.stiffness != 0 || drive.damping != 0 || is_animated(build.scene, j, i);
      if (!acts || !(drive.max_force > 0) || !joint.enabled) {
        continue;  // without force under any circumstance (S-106)
      }
      mjsJoint* target = scalar_joint(build, j, drive.dof);
      if (target != nullptr) {
        build.actuators[j].back() = add_drive(build, joint, drive, target);
      } else {
        build.report(drive.source.empty() ? joint.path : drive.source,
                     "drive:" + std::string(dof_name(drive.dof)),
                     "the driven degree of freedom is locked or is not a single coordinate here");
      }
    }
  }
}

}  // namespace tenon::engines::mujoco
