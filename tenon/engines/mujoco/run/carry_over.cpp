// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/run/carry_over.h"

#include <algorithm>
#include <cstddef>

#include "tenon/engines/mujoco/build/build.h"

namespace tenon::engines::mujoco {

Result<Model> model_in_the_middle(const scene::PhysicsScene& scene, SimulationOptions options,
                                  double time_step) {
  options.time_step = time_step;
  Diagnostics silent;  // what there is to say was said at the start
  return build_model(scene, options, silent, Begin::Middle);
}

bool same_coordinates(const scene::JointDofs& a, const scene::JointDofs& b) {
  if (a.free.size() != b.free.size() || a.ball != b.ball) {
    return false;
  }
  for (std::size_t i = 0; i < a.free.size(); ++i) {
    if (a.free[i].dof != b.free[i].dof) {
      return false;
    }
  }
  return length(a.locked.position - b.locked.position) < 1e-9 &&
         length(rotation_vector(conjugate(a.locked.orientation) * b.locked.orientation)) < 1e-9;
}

void carry_joints_over(const Model& last, Model& next) {
  const mjData& from = *last.data;
  mjData& to = *next.data;
  for (std::size_t j = 0; j < next.joints.size(); ++j) {
    const JointMap& old_map = last.joints[j];
    const JointMap& map = next.joints[j];
    if (!old_map.in_tree || !map.in_tree || !same_coordinates(old_map.dofs, map.dofs)) {
      continue;
    }
    for (std::size_t i = 0; i < map.qpos.size(); ++i) {
      to.qpos[map.qpos[i]] = from.qpos[old_map.qpos[i]];
    }
    if (map.ball_qpos >= 0 && old_map.ball_qpos >= 0 && map.reversed == old_map.reversed) {
      std::copy_n(from.qpos + old_map.ball_qpos, 4, to.qpos + map.ball_qpos);
    }
  }
}

}  // namespace tenon::engines::mujoco
