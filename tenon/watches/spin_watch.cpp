// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/watches/spin_watch.h"

#include <algorithm>
#include <cmath>

#include "tenon/math/inertia.h"
#include "tenon/scene/joint_dofs.h"

namespace tenon::watches {
namespace {

using scene::Index;

constexpr std::size_t kSpinPeriod = 32;  // steps between looks
constexpr double kSlow = 0.01;           // [rad] in a step: too slow for any error
constexpr double kLeastWobble = 1e-3;    // of the spin
constexpr double kTold = 0.05;

/// Bodies that no joint keeps from turning about two axes.
std::vector<char> free_turning(const scene::PhysicsScene& scene) {
  std::vector<char> turns(scene.bodies.size(), 1);
  const std::vector<scene::FreeRotations> rotations = wanted_rotations(scene);
  for (Index j = 0; j < scene.joints.size(); ++j) {
    const scene::Joint& joint = scene.joints[j];
    const scene::JointDofs dofs = joint_dofs(joint, rotations[j]);
    const auto angles =
        std::count_if(dofs.free.begin(), dofs.free.end(),
                      [](const scene::FreeDof& free) { return is_angular(free.dof); });
    const bool holds =
        joint.enabled && joint.kind != scene::JointKind::Distance && !dofs.ball && angles < 2;
    for (const std::optional<Index>& body : {joint.body0, joint.body1}) {
      if (holds && body) {
        turns[*body] = 0;
      }
    }
  }
  return turns;
}

bool is_of_high_order(const engines::Simulation& simulation) {
  const std::vector<scene::VendorSetting> settings = simulation.settings();
  return std::any_of(settings.begin(), settings.end(), [](const scene::VendorSetting& setting) {
    return setting.name == "integrator" && setting.token == "rk4";
  });
}

}  // namespace

SpinWatch::SpinWatch(const engines::Simulation& simulation, const scene::PhysicsScene& scene)
    : simulation_(simulation), scene_(scene) {
  if (is_of_high_order(simulation)) {
    return;
  }
  const std::vector<char> turns = free_turning(scene);
  for (Index b = 0; b < scene.bodies.size(); ++b) {
    const scene::Body& body = scene.bodies[b];
    if (turns[b] != 0 && body.enabled && !body.kinematic && body.settings.gyroscopic &&
        body.settings.locked_rotation == 0) {
      bodies_.push_back({b});
    }
  }
}

void SpinWatch::look(Watched& watched, double steps) const {
  const engines::BodyState state = simulation_.body_state(watched.body);
  const double speed = length(state.angular_velocity);
  const double dt = simulation_.time_step();
  if (!(speed * dt > kSlow)) {
    return;
  }
  const PrincipalInertia principal = principal_inertia(scene_.bodies[watched.body].inertia);
  const Vec3d spin =
      rotate(conjugate(state.pose.orientation * principal.axes), state.angular_velocity);
  const Vec3d& moments = principal.moments;
  Vec3d momentum;
  for (std::size_t i = 0; i < 3; ++i) {
    momentum[i] = moments[i] * spin[i];
  }
  const Vec3d torque = cross(spin, momentum);
  Vec3d turning;
  std::size_t main = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    turning[i] = moments[i] > 0 ? torque[i] / moments[i] : 0;
    main = std::fabs(momentum[i]) > std::fabs(momentum[main]) ? i : main;
  }
  Vec3d wobble = spin;
  wobble[main] = 0;
  if (length(wobble) > kLeastWobble * speed) {
    const double angle = length(turning) / length(wobble) * dt;
    watched.growth += steps * angle * angle / 2;
    watched.speed = std::max(watched.speed, speed);
  }
}

void SpinWatch::after_step() {
  if (steps_++ % kSpinPeriod != 0) {
    return;
  }
  for (Watched& watched : bodies_) {
    look(watched, static_cast<double>(kSpinPeriod));
  }
}

std::vector<FastSpin> SpinWatch::fast() const {
  std::vector<FastSpin> found;
  for (const Watched& watched : bodies_) {
    if (watched.growth > kTold) {
      found.push_back({watched.body, watched.speed, watched.growth});
    }
  }
  return found;
}

}  // namespace tenon::watches
