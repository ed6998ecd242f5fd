// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/watches/energy_drift.h"

#include <algorithm>
#include <cmath>

#include "tenon/scene/joint_freedom.h"

namespace tenon::watches {
namespace {

using scene::Index;

constexpr std::size_t kEnergyPeriod = 16;    // steps between looks at the energy
constexpr std::size_t kMostColliders = 256;  // of which each pair is asked about
constexpr double kOfMoved = 0.02;
constexpr double kOfBound = 0.99;  // of a velocity

bool pulls(const scene::Drive& drive) {
  return drive.max_force > 0 && (drive.stiffness != 0 || drive.damping != 0);
}

/// Nothing in the joint takes or gives energy, or stores any that is not counted.
bool keeps_energy(const scene::Joint& joint) {
  const bool bounded = joint.lower > -scene::kUnlimited || joint.upper < scene::kUnlimited ||
                       joint.cone_angle0 < scene::kUnlimited ||
                       joint.cone_angle1 < scene::kUnlimited ||
                       joint.velocity_limit < scene::kUnlimited || !joint.limits.empty();
  return !joint.enabled ||
         (joint.kind != scene::JointKind::Distance && !bounded && joint.damping == 0 &&
          joint.friction == 0 && joint.mimics.empty() && !can_break(joint) &&
          std::none_of(joint.drives.begin(), joint.drives.end(), pulls));
}

bool keeps_energy(const scene::Body& body) {
  const scene::BodySettings& settings = body.settings;
  return !body.kinematic && body.enabled && body.linear_damping == 0 && body.angular_damping == 0 &&
         settings.forces.empty() && settings.locked_translation == 0 &&
         settings.locked_rotation == 0 && !body.starts_asleep;
}

/// No two colliders may touch: a short contact leaves no trace in the states of some engines.
bool touches_nothing(const scene::PhysicsScene& scene) {
  if (scene.colliders.size() > kMostColliders) {
    return false;
  }
  for (Index one = 0; one < scene.colliders.size(); ++one) {
    for (Index other = 0; other < one; ++other) {
      if (scene.may_collide(one, other)) {
        return false;
      }
    }
  }
  return true;
}

bool is_closed(const scene::PhysicsScene& scene) {
  return scene.tendons.empty() && scene.pose_tracks.empty() && scene.bounds_tracks.empty() &&
         scene.scalar_tracks.empty() &&
         std::all_of(scene.joints.begin(), scene.joints.end(),
                     [](const scene::Joint& joint) { return keeps_energy(joint); }) &&
         std::all_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const scene::Body& body) { return keeps_energy(body); }) &&
         touches_nothing(scene);
}

}  // namespace

EnergyDriftWatch::EnergyDriftWatch(const engines::Simulation& simulation,
                                   const scene::PhysicsScene& scene)
    : simulation_(simulation), scene_(scene), closed_(is_closed(scene)) {
  if (!closed_) {
    return;
  }
  const engines::Energy energy = simulation.energy();
  start_ = energy.total();
  for (const scene::Body& body : scene.bodies) {
    const Mat3d& moments = body.inertia;
    const double size = std::sqrt((moments[0][0] + moments[1][1] + moments[2][2]) /
                                  (2 * std::max(body.mass, 1e-9)));
    moved_ += body.mass * length(simulation.gravity(body.scene)) * size;
  }
  moved_ = std::max(moved_, energy.kinetic);
}

void EnergyDriftWatch::after_step() {
  if (closed_ && ++steps_ % kEnergyPeriod == 0) {
    closed_ = !is_capped();
    moved_ = std::max(moved_, simulation_.energy().kinetic);
  }
}

/// A bound of its velocity holds a body back.
bool EnergyDriftWatch::is_capped() const {
  for (Index b = 0; b < scene_.bodies.size(); ++b) {
    const scene::BodySettings& settings = scene_.bodies[b].settings;
    if (std::isfinite(settings.max_linear_velocity) ||
        std::isfinite(settings.max_angular_velocity)) {
      const engines::BodyState state = simulation_.body_state(b);
      if (length(state.linear_velocity) > kOfBound * settings.max_linear_velocity ||
          length(state.angular_velocity) > kOfBound * settings.max_angular_velocity) {
        return true;
      }
    }
  }
  return false;
}

std::optional<EnergyDrift> EnergyDriftWatch::drift() const {
  if (!closed_ || steps_ == 0) {
    return std::nullopt;
  }
  const engines::Energy energy = simulation_.energy();
  const EnergyDrift found{energy.total() - start_, std::max(moved_, energy.kinetic)};
  const bool drifted = std::fabs(found.change) > kOfMoved * found.moved && found.moved > 0;
  return drifted ? std::optional(found) : std::nullopt;
}

}  // namespace tenon::watches
