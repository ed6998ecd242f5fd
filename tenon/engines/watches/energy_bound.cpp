// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Kinetic and potential energy and that of the springs in drives towards a position may grow by
// what inputs gave, and a scene has headroom: ten times its energy at the start and the work of its
// weight over its own size. Real motion stays far below; a run that explodes passes it within a few
// steps. What inputs gave is bounded every few steps: a target that moves gives at most
// the largest pull of its drive along its way; a drive towards a speed v with damping d at most
// d v^2 / 4 in each second, or its largest force times v; forces that were set, force times speed;
// bodies that follow poses and surfaces that carry give what they touch at most twice their speed.
// Limits, loops and dampers give nothing, except where a joint begins outside of its limits: there
// they stretch its drive.
#include "tenon/engines/watches/energy_bound.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tenon/engines/applied_forces.h"
#include "tenon/engines/drive_values.h"
#include "tenon/engines/watches/spring_energy.h"
#include "tenon/scene/joint_dofs.h"

namespace tenon::engines {
namespace {

using scene::Index;
using scene::PhysicsScene;

constexpr double kHeadroom = 10;        // times the scale of the scene
constexpr double kTimeBetween = 0.064;  // [s]
constexpr double kMostBetween = 32;     // steps
constexpr double kEarth = 9.81;         // [m/s^2]

bool moves(const scene::Body& body) { return body.enabled && !body.kinematic && body.mass > 0; }

double trace(const Mat3d& m) { return m[0][0] + m[1][1] + m[2][2]; }

/// For each body the one that its chain of joints begins with: one that a joint holds to the world
/// or to a kinematic body, if there is one.
std::vector<Index> roots_of(const PhysicsScene& scene) {
  std::vector<Index> parent(scene.bodies.size());
  for (Index b = 0; b < parent.size(); ++b) {
    parent[b] = b;
  }
  const auto find = [&](Index b) {
    while (parent[b] != b) {
      b = parent[b] = parent[parent[b]];
    }
    return b;
  };
  std::vector<char> held(parent.size(), 0);
  for (const scene::Joint& joint : scene.joints) {
    const auto fixed = [&](const std::optional<Index>& body) {
      return !body || !moves(scene.bodies[*body]);
    };
    if (!joint.enabled || (fixed(joint.body0) && fixed(joint.body1))) {
      continue;
    }
    if (fixed(joint.body0) || fixed(joint.body1)) {
      held[fixed(joint.body0) ? *joint.body1 : *joint.body0] = 1;
    } else {
      parent[find(*joint.body1)] = find(*joint.body0);
    }
  }
  std::vector<Index> root(parent.size());
  for (Index b = 0; b < root.size(); ++b) {
    root[b] = find(b);
  }
  for (Index b = 0; b < root.size(); ++b) {
    if (held[b] != 0 && held[root[b]] == 0) {
      std::replace(root.begin(), root.end(), Index{root[b]}, b);
    }
  }
  return root;
}

double kinetic(const scene::Body& body, const BodyState& state) {
  const Vec3d turn = rotate(conjugate(state.pose.orientation), state.angular_velocity);
  double twice = body.mass * dot(state.linear_velocity, state.linear_velocity);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      twice += turn[i] * body.inertia[i][k] * turn[k];
    }
  }
  return twice / 2;
}

Index fastest_body(const Simulation& simulation, const PhysicsScene& scene) {
  Index fastest = 0;
  double most = -1;
  for (Index b = 0; b < scene.bodies.size(); ++b) {
    const double energy =
        moves(scene.bodies[b]) ? kinetic(scene.bodies[b], simulation.body_state(b)) : -1;
    if (energy > most) {
      most = energy;
      fastest = b;
    }
  }
  return fastest;
}

/// What springs of tendons, balls and soft bounds may hold, which are not in Energy::potential [J].
double other_springs(const Simulation& simulation, const PhysicsScene& scene, double extent) {
  double energy = 0;
  for (const scene::Tendon& tendon : scene.tendons) {
    double reach = tendon.joints.empty() ? extent : 0;
    for (const double coefficient : tendon.coefficients) {
      reach += std::fabs(coefficient) * std::max(M_PI, extent);
    }
    energy += (tendon.stiffness + tendon.limit_stiffness) * reach * reach / 2;
  }
  for (Index j = 0; j < scene.joints.size(); ++j) {
    const scene::Joint& joint = scene.joints[j];
    energy += joint.kind == scene::JointKind::Spherical ? joint.stiffness * M_PI * M_PI / 2 : 0;
    if (joint.limit_springs.empty() || !joint.enabled) {
      continue;
    }
    const JointState state = simulation.joint_state(j);
    const scene::JointDofs dofs = joint_dofs(joint);
    for (std::size_t i = 0; i < dofs.free.size() && i < state.position.size(); ++i) {
      const double beyond = std::max(
          {dofs.free[i].lower - state.position[i], state.position[i] - dofs.free[i].upper, 0.0});
      for (const scene::LimitSpring& spring : joint.limit_springs) {
        energy += spring.dof == dofs.free[i].dof ? spring.stiffness * beyond * beyond / 2 : 0;
      }
    }
  }
  return energy;
}

}  // namespace

EnergyBound::EnergyBound(double time_step)
    : time_step_(time_step),
      between_(static_cast<std::size_t>(std::clamp(kTimeBetween / time_step, 1.0, kMostBetween))) {}

void EnergyBound::note(const Input& input) {
  const InputKind kind = input.kind;
  fresh_ = fresh_ || kind == InputKind::Parameters || kind == InputKind::JointStates ||
           kind == InputKind::BodyStates;
  if (fresh_ || kind != InputKind::DriveTargets) {
    return;
  }
  for (std::size_t i = first_[input.object]; i < drives_.size() && drives_[i].joint == input.object;
       ++i) {
    if (drives_[i].drive == input.part) {
      drives_[i].moved += std::fabs(input.numbers.front() - drives_[i].target);
      drives_[i].target = input.numbers.front();
    }
  }
}

void EnergyBound::begin(const Simulation& simulation, const PhysicsScene& scene,
                        const Steering& steering) {
  if (fresh_) {
    set_baseline(simulation, scene, steering);
  }
}

Result<void> EnergyBound::end(const Simulation& simulation, const PhysicsScene& scene,
                              const Steering& steering, std::string_view rule) {
  // Not in the first steps: there couplings and limits that are not met pull bodies together.
  ++steps_;
  if (fresh_ || !scene.bounds_tracks.empty() || steps_ % between_ != 0) {
    return {};
  }
  look(simulation, scene, steering, static_cast<double>(steps_ - looked_) * time_step_);
  looked_ = steps_;
  const Energy energy = simulation.energy();
  lowest_ = std::min(lowest_, energy.potential);
  highest_ = std::max(highest_, energy.potential);
  const double gained = energy.total() + stored_ - start_ - given_;
  const double carried = 2 * mass_ * carried_ * carried_;
  const double most = kHeadroom * (scale_ + carried) + (highest_ - lowest_) + given_;
  if (!(gained > most)) {
    return {};
  }
  char text[200];
  std::snprintf(text, sizeof text,
                "the simulation became unstable at %.6g s: bodies move with %.4g J, and neither "
                "drives nor contacts nor forces explain %.4g J that were gained",
                simulation.time(), energy.kinetic, gained);
  return Error(ErrorCode::Unstable, text)
      .with_rule(std::string(rule))
      .with_prim(scene.bodies[fastest_body(simulation, scene)].path.str())
      .with_fix(
          "start within the limits of joints, where one begins outside; else take a smaller "
          "time step or softer drives");
}

void EnergyBound::list_drives(const PhysicsScene& scene) {
  drives_.clear();
  first_.assign(scene.joints.size(), 0);
  const std::vector<scene::FreeRotations> rotations = wanted_rotations(scene);
  for (Index j = 0; j < scene.joints.size(); ++j) {
    first_[j] = drives_.size();
    const scene::Joint& joint = scene.joints[j];
    if (joint.drives.empty() || !joint.enabled) {
      continue;
    }
    const scene::JointDofs dofs = joint_dofs(joint, rotations[j]);
    for (Index d = 0; d < joint.drives.size(); ++d) {
      const auto at = std::find_if(dofs.free.begin(), dofs.free.end(), [&](const auto& free) {
        return free.dof == joint.drives[d].dof;
      });
      if (at == dofs.free.end()) {
        continue;
      }
      Driven driven{j, d, static_cast<std::size_t>(at - dofs.free.begin()), at->lower, at->upper};
      if (joint.drives[d].acceleration) {
        driven.inertia = mass_ * (is_angular(joint.drives[d].dof) ? extent_ * extent_ : 1);
      }
      drives_.push_back(driven);
    }
  }
}

void EnergyBound::set_baseline(const Simulation& simulation, const PhysicsScene& scene,
                               const Steering& steering) {
  fresh_ = false;
  steps_ = looked_ = 0;
  given_ = carried_ = mass_ = extent_ = scale_ = 0;
  const std::vector<Index> roots = roots_of(scene);
  Vec3d low{kInfinity, kInfinity, kInfinity};
  Vec3d high = low * -1;
  for (Index b = 0; b < scene.bodies.size(); ++b) {
    const scene::Body& body = scene.bodies[b];
    if (!moves(body)) {
      continue;
    }
    const Vec3d center = simulation.center_of_mass(b);
    const double size = std::sqrt(trace(body.inertia) / (2 * body.mass));
    const double reach = length(center - simulation.center_of_mass(roots[b]));
    const double gravity = std::max(length(simulation.gravity(body.scene)), kEarth);
    scale_ += body.mass * gravity * (reach + size);
    mass_ += body.mass;
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], center[i] - size);
      high[i] = std::max(high[i], center[i] + size);
    }
  }
  extent_ = mass_ > 0 ? length(high - low) : 0;
  list_drives(scene);
  look(simulation, scene, steering, 0);
  carried_ = 0;
  const Energy energy = simulation.energy();
  scale_ += energy.kinetic + stored_ + other_springs(simulation, scene, extent_);
  lowest_ = highest_ = energy.potential;
  start_ = energy.total() + stored_;
}

void EnergyBound::look(const Simulation& simulation, const PhysicsScene& scene,
                       const Steering& steering, double span) {
  look_at_drives(simulation, scene, steering, span);
  look_at_forces(simulation, scene, steering, span);
  look_at_moved(simulation, scene, span);
}

void EnergyBound::look_at_drives(const Simulation& simulation, const PhysicsScene& scene,
                                 const Steering& steering, double span) {
  stored_ = 0;
  for (std::size_t i = 0; i < drives_.size();) {
    const Index joint = drives_[i].joint;
    const std::vector<scene::Drive> drives = drives_at(scene, joint, steering, simulation.time());
    const JointState state = simulation.joint_state(joint);
    for (; i < drives_.size() && drives_[i].joint == joint; ++i) {
      Driven& driven = drives_[i];
      const scene::Drive& drive = drives[driven.drive];
      const double position =
          driven.coordinate < state.position.size() ? state.position[driven.coordinate] : 0;
      const double stiffness = drive.stiffness * driven.inertia;
      const double most = drive.max_force * (drive.acceleration ? driven.inertia : 1);
      driven.moved += std::fabs(drive.target_position - driven.target);
      driven.target = drive.target_position;
      const double stretch = std::fabs(position - driven.target);
      const double pull = std::min(stiffness * stretch, most);
      given_ += span > 0
                    ? driven.moved *
                          std::max({pull, driven.pull, std::min(stiffness * driven.moved, most)})
                    : 0;
      const double speed = std::fabs(drive.target_velocity);
      given_ += span * std::min(drive.damping * driven.inertia * speed * speed / 4, most * speed);
      const DriveSpring spring{driven.target, stiffness, most};
      const double stored = stiffness > 0 ? spring.energy_at(position) : 0;
      if (span == 0 && stiffness > 0 && !drive.acceleration) {  // the start
        given_ += spring.given_by_limit(position, driven.lower, driven.upper);
      }
      if (drive.acceleration) {  // at most so much, so it counts only when it is let go
        given_ += std::max(driven.stored - stored, 0.0);
      } else {
        stored_ += stored;
      }
      driven.moved = 0;
      driven.pull = pull;
      driven.stored = stored;
    }
  }
}

void EnergyBound::look_at_forces(const Simulation& simulation, const PhysicsScene& scene,
                                 const Steering& steering, double span) {
  const auto give = [&](const Wrench& wrench, const BodyState& state) {
    given_ += span * (length(wrench.force) * length(state.linear_velocity) +
                      length(wrench.torque) * length(state.angular_velocity));
  };
  for (const auto& [joint, efforts] : steering.efforts) {
    const JointState state = simulation.joint_state(joint);
    for (std::size_t i = 0; i < efforts.size() && i < state.velocity.size(); ++i) {
      given_ += span * std::fabs(efforts[i] * state.velocity[i]);
    }
  }
  for (const auto& [body, wrench] : steering.wrenches) {
    give(wrench, simulation.body_state(body));
  }
  for (Index b = 0; b < scene.bodies.size(); ++b) {
    if (!scene.bodies[b].settings.forces.empty()) {
      const BodyState state = simulation.body_state(b);
      give(constant_wrench(scene.bodies[b], state.pose), state);
    }
  }
}

void EnergyBound::look_at_moved(const Simulation& simulation, const PhysicsScene& scene,
                                double span) {
  const auto carries = [&](const Vec3d& linear, const Vec3d& angular) {
    carried_ = std::max(carried_, length(linear) + length(angular) * extent_);
  };
  for (Index b = 0; b < scene.bodies.size(); ++b) {
    if (scene.bodies[b].kinematic) {
      const BodyState state = simulation.body_state(b);
      carries(state.linear_velocity, state.angular_velocity);
    }
  }
  for (const scene::Collider& collider : scene.colliders) {
    if (collider.settings.surface_velocity) {
      carries(collider.settings.surface_velocity->linear,
              collider.settings.surface_velocity->angular);
    }
  }
  for (const scene::PoseTrack& track : scene.pose_tracks) {
    if (span > 0 && !track.times.empty()) {
      const Pose before = track.at(simulation.time() - span);
      const Pose now = track.at(simulation.time());
      const Quatd turn = conjugate(before.orientation) * now.orientation;
      const double angle = 2 * std::atan2(length(Vec3d{turn.x, turn.y, turn.z}), std::fabs(turn.w));
      carries((now.position - before.position) * (1 / span), Vec3d{angle / span, 0, 0});
    }
  }
}

}  // namespace tenon::engines
