// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Force times mean velocity (v + v') / 2 times dt is the work of a step, which adds up to the
// change of kinetic energy exactly, whatever the integrator made of the step. What may add energy
// is summed up from it: velocity drives, forces from outside, contacts, prescribed motion. Limits,
// loops, dampers and the integrator's residual may not: they only move energy about or take it. A
// drive towards a position may neither, beyond what its spring held at the start and what its
// target was moved by, so that a drive that is too stiff for the step is found too. A scene is
// given headroom: ten times its energy at the start and the work of its weight over its own size;
// real motion stays far below, a simulation that explodes passes it within a few steps. Sums are
// made in every step, energies only every few.
#include "tenon/engines/mujoco/run/energy_watch.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "tenon/engines/mujoco/run/read_state.h"

namespace tenon::engines::mujoco {
namespace {

constexpr double kHeadroom = 10;          // times the scale of the scene
constexpr double kOfLost = 0.01;          // how well work that was taken is known
constexpr double kWorthSplitting = 2e-3;  // of the scale, by constraints in one step
constexpr double kTimeBetween = 0.064;    // [s]
constexpr int kMostBetween = 32;          // steps
constexpr double kEarth = 9.81;           // [m/s^2]

bool is_contact(int type) {
  return type == mjCNSTR_CONTACT_FRICTIONLESS || type == mjCNSTR_CONTACT_PYRAMIDAL ||
         type == mjCNSTR_CONTACT_ELLIPTIC;
}

// What a body's weight does over its distance from where its tree is held and over its own size.
double weight_work(const mjModel& m, const mjData& d, int body, double gravity) {
  const int root = m.body_rootid[body];
  const double* held = m.body_jntnum[root] > 0 ? d.xanchor + std::ptrdiff_t{3} * m.body_jntadr[root]
                                               : d.xpos + std::ptrdiff_t{3} * root;
  const double reach = length(read_vector(d.xipos + std::ptrdiff_t{3} * body) - read_vector(held));
  const double* inertia = m.body_inertia + std::ptrdiff_t{3} * body;
  const double size = std::sqrt((inertia[0] + inertia[1] + inertia[2]) / (2 * m.body_mass[body]));
  return m.body_mass[body] * gravity * (reach + size);
}

// Whether samples change more of a drive than its target.
bool gains_follow_samples(const scene::PhysicsScene& scene, const DriveMap& map) {
  return std::any_of(scene.scalar_tracks.begin(), scene.scalar_tracks.end(),
                     [&](const scene::ScalarTrack& track) {
                       return track.joint == map.joint && track.drive == map.drive &&
                              track.what != scene::Animated::DriveTargetPosition;
                     });
}

bool some(const mjtNum* numbers, mjtSize count) {
  return std::any_of(numbers, numbers + count, [](mjtNum number) { return number != 0; });
}

/// Whether anything but joints, contacts, drives and constraints moves the model in a state like
/// this one: what was applied to it, a fluid, compensated gravity, soft bodies, plugins.
bool has_outside_forces(const mjModel& m, const mjData& d) {
  return m.ngravcomp > 0 || m.opt.density != 0 || m.opt.viscosity != 0 || m.nflex > 0 ||
         m.nplugin > 0 || some(d.qfrc_applied, m.nv) || some(d.xfrc_applied, 6 * m.nbody);
}

int fastest_body(const Model& model) {
  const mjModel& m = *model.model;
  derive_motion(model);
  int fastest = 0;
  double most = 0;
  for (int b = 1; b < m.nbody; ++b) {
    double v[6];
    mj_objectVelocity(&m, model.data.get(), mjOBJ_BODY, b, v, 1);
    double energy = m.body_mass[b] * (v[3] * v[3] + v[4] * v[4] + v[5] * v[5]);
    for (int i = 0; i < 3; ++i) {
      energy += m.body_inertia[3 * b + i] * v[i] * v[i];
    }
    const bool driven = std::any_of(model.bodies.begin(), model.bodies.end(),
                                    [&](const auto& map) { return map.id == b && map.mass == 0; });
    if (energy > most && !driven) {
      most = energy;
      fastest = b;
    }
  }
  return fastest;
}

}  // namespace

EnergyWatch::EnergyWatch(const scene::PhysicsScene& scene, const Model& model) {
  const mjModel& m = *model.model;
  velocity_.assign(static_cast<std::size_t>(m.nv), 0);
  scratch_ = velocity_;
  between_ = static_cast<int>(
      std::clamp(kTimeBetween / m.opt.timestep, 1.0, static_cast<double>(kMostBetween)));
  moved_ = !scene.pose_tracks.empty() || !scene.bounds_tracks.empty();
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.plan.bases[b] == BodyBase::Driven) {
      driven_.push_back(model.bodies[b].free_dof);
      driven_bodies_.push_back(model.bodies[b].id);
      moved_ = true;
    }
  }
  for (std::size_t i = 0; i < model.drives.size(); ++i) {
    const DriveMap& map = model.drives[i];
    if (map.actuator >= 0 && !scene.joints[map.joint].drives[map.drive].acceleration &&
        !gains_follow_samples(scene, map)) {
      candidates_.push_back(i);
    }
  }
}

void EnergyWatch::give(double work) {
  explained_ += work;
  (work > 0 ? gained_ : lost_) += std::fabs(work);
}

void EnergyWatch::read_springs(const Model& model) {
  const mjModel& m = *model.model;
  const mjData& d = *model.data;
  springs_.clear();
  for (const std::size_t i : candidates_) {
    const DriveMap& map = model.drives[i];
    const double stiffness = -m.actuator_biasprm[mjNBIAS * map.actuator + 1];
    if (d.ctrl[map.control + 1] != 0 || !(stiffness >= 0)) {
      continue;
    }
    const double most = m.actuator_forcelimited[map.actuator] != 0
                            ? m.actuator_forcerange[2 * map.actuator + 1]
                            : scene::kUnlimited;
    springs_.push_back({map.actuator,
                        map.control,
                        m.jnt_qposadr[m.dof_jntid[map.dof]],
                        map.dof,
                        {d.ctrl[map.control], stiffness, most}});
  }
  only_springs_ = springs_.size() == static_cast<std::size_t>(m.nu);
  controls_.assign(d.ctrl, d.ctrl + m.nu);
}

void EnergyWatch::begin(const Model& model, bool pushed) {
  const mjData& d = *model.data;
  pushed_ = pushed;
  if (fresh_) {
    read_springs(model);
    positions_.assign(d.qpos, d.qpos + model.model->nq);
  } else if (!controls_.empty() &&
             std::memcmp(controls_.data(), d.ctrl, controls_.size() * sizeof(double)) != 0) {
    follow_targets(model);
  }
  std::copy_n(d.qvel, velocity_.size(), velocity_.begin());
}

void EnergyWatch::follow_targets(const Model& model) {
  const mjData& d = *model.data;
  for (Spring& spring : springs_) {
    if (d.ctrl[spring.control] != spring.drive.target) {
      const double position = d.qpos[spring.qpos];
      const double before = spring.drive.energy_at(position);
      spring.drive.target = d.ctrl[spring.control];
      give(spring.drive.energy_at(position) - before);
    }
    if (d.ctrl[spring.control + 1] != 0) {
      fresh_ = true;  // from now on a drive of velocity
    }
  }
  std::copy_n(d.ctrl, controls_.size(), controls_.begin());
}

std::optional<EnergyWatch::Growth> EnergyWatch::end(const Model& model) {
  if (fresh_) {
    set_baseline(model);
  }
  add_work(model);
  // Of the first steps more often: what begins badly explodes there.
  ++steps_;
  const bool early = steps_ < between_ && (steps_ & (steps_ - 1)) == 0;
  return early || steps_ % between_ == 0 ? judge(model) : std::nullopt;
}

// Derived numbers and forces are those of the beginning of the step; positions are not.
void EnergyWatch::set_baseline(const Model& model) {
  const mjModel& m = *model.model;
  mjData& d = *model.data;
  fresh_ = false;
  steps_ = 0;
  outside_ = has_outside_forces(m, d);
  read_springs(model);
  explained_ = gained_ = lost_ = 0;
  const double gravity = std::max(length(read_vector(m.opt.gravity)), kEarth);
  const double kinetic = kinetic_energy(model, velocity_.data());
  double stretched = 0;
  for (const Spring& spring : springs_) {
    const double position = d.actuator_length[spring.actuator];
    stretched += spring.drive.energy_at(position);
    const int joint = m.dof_jntid[spring.dof];
    if (m.jnt_limited[joint] != 0) {
      const double* range = m.jnt_range + std::ptrdiff_t{2} * joint;
      give(spring.drive.given_by_limit(position, range[0], range[1]));
    }
  }
  scale_ = kinetic + stretched;
  for (int b = 1; b < m.nbody; ++b) {
    const bool stands =
        m.body_weldid[b] == 0 || m.body_mass[b] <= 0 ||
        std::find(driven_bodies_.begin(), driven_bodies_.end(), b) != driven_bodies_.end();
    scale_ += stands ? 0 : weight_work(m, d, b, gravity);
  }
  std::swap_ranges(positions_.begin(), positions_.end(), d.qpos);
  lowest_ = highest_ = potential_energy(model);
  std::swap_ranges(positions_.begin(), positions_.end(), d.qpos);
  start_ = kinetic + stretched + lowest_;
}

// The sum of what may give energy; what constraints do is looked at by itself where it is much.
void EnergyWatch::add_work(const Model& model) {
  const double by_constraints = work_of(model.data->qfrc_constraint, model);
  double work = by_constraints;
  if (pushed_ || outside_) {
    work += work_from_outside(model);
  }
  if (!only_springs_) {
    work += work_of_other_drives(model);
  }
  if (!driven_.empty()) {
    work += work_of_driven(model);
  }
  if (!moved_ && work > kWorthSplitting * scale_) {
    work += work_of_contacts(model) - by_constraints;
  }
  give(work);
}

/// Of one force for each degree of freedom.
double EnergyWatch::work_of(const double* forces, const Model& model) const {
  const double* const velocity = model.data->qvel;
  double twice = 0;
  for (std::size_t i = 0; i < velocity_.size(); ++i) {
    twice += forces[i] * (velocity_[i] + velocity[i]);
  }
  return twice * model.model->opt.timestep / 2;
}

// The work of all forces except springs, dampers and drives.
double EnergyWatch::work_from_outside(const Model& model) const {
  const mjData& d = *model.data;
  double twice = 0;
  for (std::size_t i = 0; i < velocity_.size(); ++i) {
    const double force = d.qfrc_smooth[i] + d.qfrc_bias[i] - d.qfrc_spring[i] - d.qfrc_damper[i] -
                         d.qfrc_actuator[i];
    twice += force * (velocity_[i] + d.qvel[i]);
  }
  return twice * model.model->opt.timestep / 2;
}

// Of actuators that are no springs.
double EnergyWatch::work_of_other_drives(const Model& model) const {
  const mjData& d = *model.data;
  double twice = 0;
  for (const Spring& spring : springs_) {
    const auto dof = static_cast<std::size_t>(spring.dof);
    twice += d.actuator_force[spring.actuator] * (velocity_[dof] + d.qvel[dof]);
  }
  return work_of(d.qfrc_actuator, model) - twice * model.model->opt.timestep / 2;
}

double EnergyWatch::work_of_contacts(const Model& model) const {
  const mjModel& m = *model.model;
  const mjData& d = *model.data;
  std::vector<double> mean(velocity_);
  for (std::size_t i = 0; i < mean.size(); ++i) {
    mean[i] = (mean[i] + d.qvel[i]) / 2;
  }
  std::vector<double> rows(static_cast<std::size_t>(d.nefc));
  mj_mulJacVec(&m, &d, rows.data(), mean.data());
  double work = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    work += is_contact(d.efc_type[i]) ? m.opt.timestep * rows[i] * d.efc_force[i] : 0;
  }
  return work;
}

// Instead of the work on driven bodies themselves, that on what hangs on them: whatever moved a
// driven body aside, except constraints, came through the joints of its tree.
double EnergyWatch::work_of_driven(const Model& model) const {
  const mjModel& m = *model.model;
  const mjData& d = *model.data;
  double work = 0;
  for (std::size_t k = 0; k < driven_.size(); ++k) {
    const double mass = m.body_mass[driven_bodies_[k]];  // and each moment of inertia
    for (std::size_t i = 0; i < 6; ++i) {
      const auto dof = static_cast<std::size_t>(driven_[k]) + i;
      const double impulse = mass * (d.qvel[dof] - velocity_[dof]) -
                             m.opt.timestep * (d.qfrc_applied[dof] + d.qfrc_constraint[dof]);
      const double forces = d.qfrc_smooth[dof] + d.qfrc_bias[dof] + d.qfrc_constraint[dof] -
                            d.qfrc_spring[dof] - d.qfrc_damper[dof];
      work -= impulse * d.qvel[dof];
      work -= forces * (velocity_[dof] + d.qvel[dof]) * m.opt.timestep / 2;
    }
  }
  return work;
}

// Of all but driven bodies.
double EnergyWatch::kinetic_energy(const Model& model, const double* velocity) {
  const mjModel& m = *model.model;
  mj_mulM(&m, model.data.get(), scratch_.data(), velocity);
  double energy = 0;
  for (std::size_t i = 0; i < scratch_.size(); ++i) {
    energy += velocity[i] * scratch_[i] / 2;
  }
  for (std::size_t k = 0; k < driven_.size(); ++k) {
    for (int i = driven_[k]; i < driven_[k] + 6; ++i) {
      energy -= m.body_mass[driven_bodies_[k]] * velocity[i] * velocity[i] / 2;
    }
  }
  return energy;
}

double EnergyWatch::potential_energy(const Model& model) const {
  const mjModel& m = *model.model;
  mjData& d = *model.data;
  mj_energyPos(&m, &d);
  double energy = d.energy[0];
  for (const int body : driven_bodies_) {
    const Vec3d center = read_vector(d.xipos + std::ptrdiff_t{3} * body);
    const bool falls = (m.opt.disableflags & mjDSBL_GRAVITY) == 0;
    energy += falls ? m.body_mass[body] * dot(read_vector(m.opt.gravity), center) : 0;
  }
  return energy;
}

std::optional<EnergyWatch::Growth> EnergyWatch::judge(const Model& model) {
  const mjData& d = *model.data;
  const double kinetic = kinetic_energy(model, d.qvel);
  const double potential = potential_energy(model);
  lowest_ = std::min(lowest_, potential);
  highest_ = std::max(highest_, potential);
  double energy = kinetic + potential;
  for (const Spring& spring : springs_) {
    energy += spring.drive.energy_at(d.actuator_length[spring.actuator]);
  }
  // What limits feed and contacts take at once moves nothing: the energy itself has to have grown.
  const double grown = energy - start_;
  const double unexplained = std::min(grown, grown - explained_);
  const double most = kHeadroom * scale_ + (highest_ - lowest_) + gained_ + kOfLost * lost_;
  if (!(unexplained > most)) {
    return std::nullopt;
  }
  return Growth{kinetic, unexplained, fastest_body(model)};
}

}  // namespace tenon::engines::mujoco
