// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/run/carry_over.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "tenon/engines/mujoco/build/build.h"
#include "tenon/engines/mujoco/build/min_inertia.h"
#include "tenon/math/inertia.h"

namespace tenon::engines::mujoco {

Result<Model> model_in_the_middle(const scene::PhysicsScene& scene, SimulationOptions options,
                                  double time_step) {
  options.time_step = time_step;
  Diagnostics silent;  // what there is to say was said at the start
  return build_model(scene, options, silent, Begin::Middle);
}

std::unique_ptr<scene::Timeline> timeline_of(const scene::PhysicsScene& scene) {
  scene::BodyMass least;
  least.mass = kMinMass;
  least.inertia = {};
  for (std::size_t i = 0; i < 3; ++i) {
    least.inertia[i][i] = kMinMoment;
  }
  return std::make_unique<scene::Timeline>(scene, least);
}

bool same_coordinates(const JointDofs& a, const JointDofs& b) {
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
      to.qvel[map.dof[i]] = from.qvel[old_map.dof[i]];
    }
    if (map.ball_qpos >= 0 && old_map.ball_qpos >= 0 && map.reversed == old_map.reversed) {
      std::copy_n(from.qpos + old_map.ball_qpos, 4, to.qpos + map.ball_qpos);
      std::copy_n(from.qvel + old_map.ball_dof, 3, to.qvel + map.ball_dof);
    }
  }
}

void join_momentum(const scene::Body& body, const BodyMap& map, Model& model) {
  mjData& data = *model.data;
  const auto nv = static_cast<std::size_t>(model.model->nv);
  std::vector<double> move(3 * nv);
  std::vector<double> turn(3 * nv);
  const Pose engine{read_vector(data.xpos + std::ptrdiff_t{3} * map.id),
                    read_quaternion(data.xquat + std::ptrdiff_t{4} * map.id)};
  const Pose pose = engine * inverse(map.engine_frame);
  const Vec3d center = transform_point(pose, body.center_of_mass);
  mj_jac(model.model.get(), &data, move.data(), turn.data(), center.v.data(), map.id);
  Vec3d excess = body.linear_velocity;
  Vec3d excess_spin = body.angular_velocity;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < nv; ++k) {
      excess[i] -= move[i * nv + k] * data.qvel[k];
      excess_spin[i] -= turn[i * nv + k] * data.qvel[k];
    }
  }
  const Vec3d impulse = excess * body.mass;
  const Mat3d inertia = rotate_inertia(pose.orientation, body.inertia);
  Vec3d twist;
  for (std::size_t i = 0; i < 3; ++i) {
    twist[i] = dot({{inertia[i][0], inertia[i][1], inertia[i][2]}}, excess_spin);
  }
  std::vector<double> generalized(nv);
  std::vector<double> change(nv);
  for (std::size_t k = 0; k < nv; ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      generalized[k] += move[i * nv + k] * impulse[i] + turn[i * nv + k] * twist[i];
    }
  }
  mj_solveM(model.model.get(), &data, change.data(), generalized.data(), 1);
  for (std::size_t k = 0; k < nv; ++k) {
    data.qvel[k] += change[k];
  }
}

}  // namespace tenon::engines::mujoco
