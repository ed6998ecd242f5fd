// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/run/moving_bounds.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "tenon/engines/mujoco/build/build.h"
#include "tenon/engines/mujoco/run/carry_over.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::engines::mujoco {
namespace {

void set_range(mjModel& m, int joint, const scene::FreeDof& dof,
               const scene::MujocoSoftness& softness) {
  constexpr double kOpenEnd = 1e10;
  const bool limited = dof.lower > -scene::kUnlimited || dof.upper < scene::kUnlimited;
  if (limited && m.jnt_limited[joint] == 0) {
    soften_limit(m.opt.timestep, softness, m.jnt_solref + std::ptrdiff_t{mjNREF} * joint,
                 m.jnt_solimp + std::ptrdiff_t{mjNIMP} * joint);
  }
  m.jnt_limited[joint] = limited ? 1 : 0;
  m.jnt_range[std::ptrdiff_t{2} * joint] = std::max(dof.lower, -kOpenEnd);
  m.jnt_range[2 * joint + 1] = std::min(dof.upper, kOpenEnd);
}

}  // namespace

MovingBounds::MovingBounds(const scene::PhysicsScene& scene, const Model& model) {
  const mjModel* m = model.model.get();
  for (const scene::BoundsTrack& track : scene.bounds_tracks) {
    const std::string name = scene.joints[track.joint].path.str();
    Bounded bounded{track.joint};
    bounded.tendon_max = mj_name2id(m, mjOBJ_TENDON, (name + ".distance.max").c_str());
    bounded.tendon_min = mj_name2id(m, mjOBJ_TENDON, (name + ".distance.min").c_str());
    bounded.tendon_cone = mj_name2id(m, mjOBJ_TENDON, (name + ".cone").c_str());
    if (bounded.tendon_cone >= 0) {
      const double angle = circular_cone(scene.joints[track.joint]);
      bounded.cone_reach = m->tendon_range[2 * bounded.tendon_cone + 1] / std::sin(angle / 2);
    }
    bounded_.push_back(bounded);
  }
}

bool MovingBounds::write(const scene::PhysicsScene& scene, Model& model) const {
  bool fits = true;
  for (const Bounded& bounded : bounded_) {
    const scene::Joint& joint = scene.joints[bounded.joint];
    if (joint.enabled && !write(joint, bounded, model)) {
      fits = false;
    }
  }
  return fits;
}

// Bounds on coordinates and tendons that there are; false where the model lacks one.
bool MovingBounds::write(const scene::Joint& joint, const Bounded& bounded, Model& model) {
  mjModel& m = own_model(model);
  const JointMap& map = model.joints[bounded.joint];
  const scene::JointDofs dofs = joint_dofs(joint, map.dofs.rotations);
  if (!same_coordinates(dofs, map.dofs)) {
    return false;
  }
  for (std::size_t i = 0; map.in_tree && i < dofs.free.size(); ++i) {
    set_range(m, m.dof_jntid[map.dof[i]], dofs.free[i], joint.parts.mujoco);
  }
  const scene::Limit distance = distance_limit(joint);
  const double cone = circular_cone(joint);
  const bool fits = (distance.upper < scene::kUnlimited) == (bounded.tendon_max >= 0) &&
                    (distance.lower > -scene::kUnlimited) == (bounded.tendon_min >= 0) &&
                    (cone < M_PI) == (bounded.tendon_cone >= 0);
  if (!fits) {
    return false;
  }
  if (bounded.tendon_max >= 0) {
    m.tendon_range[2 * bounded.tendon_max + 1] = std::max(distance.upper, 1e-9);
  }
  if (bounded.tendon_min >= 0) {
    m.tendon_range[std::ptrdiff_t{2} * bounded.tendon_min] = distance.lower;
  }
  if (bounded.tendon_cone >= 0) {
    m.tendon_range[2 * bounded.tendon_cone + 1] = bounded.cone_reach * std::sin(cone / 2);
  }
  return true;
}

}  // namespace tenon::engines::mujoco
