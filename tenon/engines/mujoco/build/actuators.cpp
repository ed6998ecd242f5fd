// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A drive is MuJoCo's PID actuator without the I: inputs position and velocity target, force
// k (x* - q) + d (v* - v) clamped as one to +-max_force (S-102). Gains of acceleration drives are
// multiplied by the effective inertia before each step (S-104), so here they stand unscaled.
//
// Other readers do not know that actuator. Text has the common affine one, whose force
// k u - k q - d v is the same as long as v* = 0. Where v* is something else, a second actuator
// d u - d v is added to k u - k q, and the joint clamps their sum. A drive that has an effort but
// no gains is the limit of its joint: a controller of that robot finds it there.
//
// A drive that may be stiff gets a tendon, too, by which it can be solved with constraints
// (run/coupled_drives.h); compile() decides.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tenon/engines/mujoco/build/build.h"

namespace tenon::engines::mujoco {
namespace {

void limit_force(mjsActuator& actuator, const scene::Drive& drive) {
  actuator.forcelimited = drive.max_force < scene::kUnlimited ? mjLIMITED_TRUE : mjLIMITED_FALSE;
  if (drive.max_force < scene::kUnlimited) {
    actuator.forcerange[0] = -drive.max_force;
    actuator.forcerange[1] = drive.max_force;
  }
  actuator.ctrllimited = mjLIMITED_FALSE;
}

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
  limit_force(*actuator, drive);
  return actuator;
}

void limit_joint(mjsJoint& joint, const scene::Drive& drive) {
  if (drive.max_force < scene::kUnlimited) {
    joint.actfrclimited = mjLIMITED_TRUE;
    joint.actfrcrange[0] = -drive.max_force;
    joint.actfrcrange[1] = drive.max_force;
  }
}

/// force = gain u - stiffness q - damping v
mjsActuator* add_affine(Build& build, const std::string& name, mjsJoint* target, double gain,
                        double stiffness, double damping) {
  mjsActuator* actuator = mjs_addActuator(build.spec.get(), nullptr);
  mjs_setName(actuator->element, name.c_str());
  actuator->trntype = mjTRN_JOINT;
  mjs_setString(actuator->target, mjs_getString(mjs_getName(target->element)));
  actuator->gaintype = mjGAIN_FIXED;
  actuator->gainprm[0] = gain;
  actuator->biastype = mjBIAS_AFFINE;
  actuator->biasprm[1] = stiffness == 0 ? 0 : -stiffness;
  actuator->biasprm[2] = damping == 0 ? 0 : -damping;
  actuator->ctrllimited = mjLIMITED_FALSE;
  actuator->forcelimited = mjLIMITED_FALSE;
  return actuator;
}

/// The same for other readers; the second is for the target velocity, where one is needed.
std::array<mjsActuator*, 2> add_plain_drive(Build& build, const scene::Joint& joint,
                                            const scene::Drive& drive, mjsJoint* target,
                                            bool velocity_moves) {
  const std::string name = joint.path.str() + ".drive." + std::string(dof_name(drive.dof));
  if (drive.stiffness == 0) {
    mjsActuator* made = add_affine(build, name, target, drive.damping, 0, drive.damping);
    limit_force(*made, drive);
    return {made, nullptr};
  }
  if (drive.damping == 0 || (drive.target_velocity == 0 && !velocity_moves)) {
    mjsActuator* made =
        add_affine(build, name, target, drive.stiffness, drive.stiffness, drive.damping);
    limit_force(*made, drive);
    return {made, nullptr};
  }
  limit_joint(*target, drive);
  return {add_affine(build, name, target, drive.stiffness, drive.stiffness, 0),
          add_affine(build, name + ".velocity", target, drive.damping, 0, drive.damping)};
}

bool is_animated(const scene::PhysicsScene& scene, scene::Index joint, std::size_t drive) {
  for (const scene::ScalarTrack& track : scene.scalar_tracks) {
    if (track.joint == joint && track.drive == drive) {
      return true;
    }
  }
  return false;
}

/// Of one body of a joint alone, along or about an axis at the joint [kg or kg m^2].
double own_inertia(const scene::Body& body, const Pose& frame, scene::Dof dof) {
  if (!is_angular(dof)) {
    return body.mass;
  }
  const Vec3d axis = rotate(frame.orientation, unit_axis(static_cast<scene::Axis>(axis_of(dof))));
  const Vec3d off = cross(axis, body.center_of_mass - frame.position);
  return dot(axis, axis * body.inertia) + body.mass * dot(off, off);
}

/// Whether a drive may turn out to be stiff (compile()), once it is known what its joint moves:
/// less than one body alone, where the others give way.
bool may_be_stiff(const Build& build, const scene::Joint& joint, const scene::Drive& drive) {
  constexpr double kSure = 0.05;
  const double implicit = (drive.damping + drive.stiffness * build.time_step) * build.time_step;
  if (drive.acceleration) {
    return implicit > kSure;
  }
  double least = scene::kUnlimited;
  for (const auto& [body, frame] :
       {std::pair(joint.body0, joint.frame0), std::pair(joint.body1, joint.frame1)}) {
    if (body) {
      least = std::min(least, own_inertia(build.scene.bodies[*body], frame, drive.dof));
    }
  }
  return implicit > kSure * (least + joint.armature);
}

mjsTendon* add_drive_tendon(Build& build, const mjsActuator& actuator) {
  mjsTendon* tendon = mjs_addTendon(build.spec.get(), nullptr);
  mjs_setName(tendon->element, mjs_getString(mjs_getName(actuator.element)));
  mjs_wrapJoint(tendon, mjs_getString(actuator.target), 1);
  return tendon;
}

}  // namespace

void add_actuators(Build& build) {
  build.drive_tendons.assign(build.scene.joints.size(), {});
  build.actuators.assign(build.scene.joints.size(), {});
  build.velocity_actuators.assign(build.scene.joints.size(), {});
  for (scene::Index j = 0; j < build.scene.joints.size(); ++j) {
    const scene::Joint& joint = build.scene.joints[j];
    for (std::size_t i = 0; i < joint.drives.size(); ++i) {
      const scene::Drive& drive = joint.drives[i];
      build.actuators[j].push_back(nullptr);
      build.velocity_actuators[j].push_back(nullptr);
      build.drive_tendons[j].push_back(nullptr);
      const bool acts =
          drive.stiffness != 0 || drive.damping != 0 || is_animated(build.scene, j, i);
      mjsJoint* target = scalar_joint(build, j, drive.dof);
      const bool is_text = build.purpose == Purpose::Text;
      if (!acts || !(drive.max_force > 0) || !joint.enabled) {
        if (is_text && !acts && target != nullptr && drive.max_force > 0) {
          limit_joint(*target, drive);
        }
        continue;  // without force under any circumstance (S-106)
      }
      if (target != nullptr && is_text) {
        const auto [made, beside] =
            add_plain_drive(build, joint, drive, target, is_animated(build.scene, j, i));
        build.actuators[j].back() = made;
        build.velocity_actuators[j].back() = beside;
      } else if (target != nullptr) {
        build.actuators[j].back() = add_drive(build, joint, drive, target);
        build.drive_tendons[j].back() = may_be_stiff(build, joint, drive)
                                            ? add_drive_tendon(build, *build.actuators[j].back())
                                            : nullptr;
      } else {
        build.report(drive.source.empty() ? joint.path : drive.source,
                     "drive:" + std::string(dof_name(drive.dof)),
                     "the driven degree of freedom is locked or is not a single coordinate here");
      }
    }
  }
}

}  // namespace tenon::engines::mujoco
