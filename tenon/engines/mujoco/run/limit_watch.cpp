// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/run/limit_watch.h"

#include <algorithm>
#include <cstddef>

#include "tenon/math/angle.h"

namespace tenon::engines::mujoco {
namespace {

constexpr double kTold = 5;        // degrees/s
constexpr double kToldWay = 0.02;  // m/s
constexpr double kMostBack = 0.2;  // of the speed; what is faster is pulled by something else
constexpr int kLongest = 60;       // steps beyond a limit

bool is_ours(const scene::Joint& joint) {
  return joint.limit_springs.empty() && joint.parts.mujoco.solref_limit.empty() &&
         joint.parts.mujoco.solimp_limit.empty();
}

}  // namespace

LimitWatch::LimitWatch(const scene::PhysicsScene& scene, const Model& model)
    : joints_(static_cast<std::size_t>(model.model->njnt)) {
  for (scene::Index j = 0; j < model.joints.size(); ++j) {
    const JointMap& map = model.joints[j];
    for (std::size_t i = 0; i < map.dof.size() && is_ours(scene.joints[j]); ++i) {
      if (map.dof[i] >= 0) {
        Watched& watched = joints_[static_cast<std::size_t>(model.model->dof_jntid[map.dof[i]])];
        watched.joint = j;
        watched.angular = is_angular(map.dofs.free[i].dof);
        watched.told = false;
      }
    }
  }
}

std::vector<LimitWatch::Rebound> LimitWatch::look(const Model& model) {
  const mjData& d = *model.data;
  std::vector<Rebound> found;
  for (int row = d.ne + d.nf; row < d.ne + d.nf + d.nl; ++row) {
    if (d.efc_type[row] != mjCNSTR_LIMIT_JOINT) {
      continue;
    }
    Watched& watched = joints_[static_cast<std::size_t>(d.efc_id[row])];
    if (watched.told) {
      continue;
    }
    if (d.time - watched.last > 1.5 * model.model->opt.timestep) {
      watched.steps = 0;
      watched.before = watched.after = 0;
    }
    watched.last = d.time;
    ++watched.steps;
    const double back = d.efc_vel[row];
    watched.before = std::max(watched.before, -back);
    if (back > watched.after) {
      watched.after = back;  // may still grow
    } else if (watched.after > (watched.angular ? kTold * kRadians : kToldWay) &&
               watched.after < kMostBack * watched.before && watched.steps <= kLongest) {
      watched.told = true;
      found.push_back({watched.joint, watched.angular, watched.before, watched.after});
    }
  }
  return found;
}

}  // namespace tenon::engines::mujoco
