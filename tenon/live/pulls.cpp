// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/live/pulls.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tenon::live {
namespace {

// Of the spring [rad/s]: what hangs on it sags by a centimetre.
constexpr double kFrequency = 2 * 3.14159265358979323846 * 5;
constexpr double kStablePart = 0.1;  // of the stiffness at which one explicit step would overshoot

/// Mass of all bodies that joints connect with each one, kinematic bodies and the world apart.
std::vector<double> masses_of_trees(const scene::PhysicsScene& scene) {
  std::vector<scene::Index> tree(scene.bodies.size());
  std::iota(tree.begin(), tree.end(), 0u);
  const auto root_of = [&](scene::Index body) {
    while (tree[body] != body) {
      tree[body] = tree[tree[body]];
      body = tree[body];
    }
    return body;
  };
  for (const scene::Joint& joint : scene.joints) {
    if (joint.enabled && joint.body0 && joint.body1) {
      tree[root_of(*joint.body0)] = root_of(*joint.body1);
    }
  }
  std::vector<double> sums(scene.bodies.size());
  for (scene::Index i = 0; i < scene.bodies.size(); ++i) {
    sums[root_of(i)] += scene.bodies[i].kinematic ? 0 : scene.bodies[i].mass;
  }
  std::vector<double> masses(scene.bodies.size());
  for (scene::Index i = 0; i < scene.bodies.size(); ++i) {
    masses[i] = sums[root_of(i)];
  }
  return masses;
}

}  // namespace

void Pulls::begin(const scene::PhysicsScene& scene) {
  pulls_.clear();
  pulled_.clear();
  tree_masses_ = masses_of_trees(scene);
}

Vec3d Pulls::force_of(const Pull& pull, const engines::World& world,
                      const scene::Body& body) const {
  if (!pull.to_target) {
    return pull.force;
  }
  const engines::BodyState state = world.body_state(pull.body);
  const Vec3d point = transform_point(state.pose, pull.anchor);
  const Vec3d arm = point - world.center_of_mass(pull.body);
  const Vec3d velocity = state.linear_velocity + cross(state.angular_velocity, arm);
  const double step = world.time_step();
  const double stiffness = std::min(tree_masses_[pull.body] * kFrequency * kFrequency,
                                    kStablePart * body.mass / (step * step));
  const double damping =
      std::min(2 * std::sqrt(stiffness * body.mass), kStablePart * body.mass / step);
  return (pull.target - point) * stiffness - velocity * damping;
}

Result<void> Pulls::apply(engines::World& world, const scene::PhysicsScene& scene) {
  if (pulls_.empty() && pulled_.empty()) {
    return {};
  }
  std::map<scene::Index, engines::Wrench> sums;
  for (const scene::Index body : pulled_) {
    sums[body] = {};
  }
  for (const auto& [client, pull] : pulls_) {
    const Vec3d point = transform_point(world.body_state(pull.body).pose, pull.anchor);
    const engines::Wrench wrench = engines::wrench_at(
        force_of(pull, world, scene.bodies[pull.body]), point, world.center_of_mass(pull.body));
    engines::Wrench& sum = sums[pull.body];
    sum.force = sum.force + wrench.force;
    sum.torque = sum.torque + wrench.torque;
  }
  pulled_.clear();
  for (const auto& [body, wrench] : sums) {
    TENON_CHECK(world.set_body_wrench(body, wrench));
  }
  for (const auto& [client, pull] : pulls_) {
    pulled_.insert(pull.body);
  }
  return {};
}

}  // namespace tenon::live
