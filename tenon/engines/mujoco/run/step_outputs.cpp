// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// After mj_step the derived quantities are those of the beginning of the step and the velocities
// those of its end. The integrators treat some forces implicitly: what acted in truth is
//   M (v' - v) / dt = forces that MuJoCo names + correction,
// and the correction belongs to damping, as far as damping alone makes one, else to drives. Work is
// force times mean velocity (v + v') / 2 times dt, which adds up to the change of kinetic energy
// exactly while M does not change. MuJoCo computes reactions and accelerations from the
// accelerations (v' - v) / dt in place of its own, and from v, so that they too are what happened.
#include "tenon/engines/mujoco/run/step_outputs.h"

#include <algorithm>
#include <cstddef>

#include "tenon/engines/mujoco/build/build.h"
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/mujoco/run/body_forces.h"
#include "tenon/engines/mujoco/run/read_state.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Index;
using scene::PhysicsScene;

double dot_of(const double* a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    sum += a[i] * b[i];
  }
  return sum;
}

Vec3d times(const double* rows, const std::vector<double>& v) {
  return {{dot_of(rows, v), dot_of(rows + v.size(), v), dot_of(rows + 2 * v.size(), v)}};
}

// Whether this integrator takes damping of joints at the end of the step.
bool damps_implicitly(const mjModel& m) {
  switch (m.opt.integrator) {
    case mjINT_EULER:
      return (m.opt.disableflags & mjDSBL_EULERDAMP) == 0;
    case mjINT_RK4:
      return false;
    default:
      return true;
  }
}

// Gravity that a body does not feel is an external force, which MuJoCo does not count among those
// between bodies.
class LiftedBodies {
 public:
  LiftedBodies(const mjModel& m, mjData& d)
      : data_(d), kept_(d.xfrc_applied, d.xfrc_applied + (m.ngravcomp > 0 ? 6 * m.nbody : 0)) {
    for (int b = 1; m.ngravcomp > 0 && b < m.nbody; ++b) {
      for (int i = 0; i < 3; ++i) {
        d.xfrc_applied[6 * b + i] -= m.body_mass[b] * m.body_gravcomp[b] * m.opt.gravity[i];
      }
    }
  }
  ~LiftedBodies() { std::copy(kept_.begin(), kept_.end(), data_.xfrc_applied); }
  LiftedBodies(const LiftedBodies&) = delete;
  LiftedBodies& operator=(const LiftedBodies&) = delete;

 private:
  mjData& data_;
  std::vector<double> kept_;
};

}  // namespace

StepOutputs::StepOutputs(const Outputs& wanted, const PhysicsScene& scene, const Model& model)
    : wanted_(wanted) {
  const auto nv = static_cast<std::size_t>(model.model->nv);
  driven_.assign(nv, 0);
  drive_of_dof_.assign(nv, 0);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.plan.bases[b] == BodyBase::Driven) {
      std::fill_n(driven_.begin() + model.bodies[b].free_dof, 6, 1);
    }
  }
  for (const DriveMap& map : model.drives) {
    if (map.actuator >= 0) {
      ++drive_of_dof_[static_cast<std::size_t>(map.dof)];
    }
  }
  if (wanted_.reactions) {
    carriers_ = find_carriers(scene, model);
  }
}

void StepOutputs::begin(const PhysicsScene& scene, const Model& model) {
  const mjModel& m = *model.model;
  const mjData& d = *model.data;
  position_.assign(d.qpos, d.qpos + m.nq);
  velocity_.assign(d.qvel, d.qvel + m.nv);
  if (wanted_.accelerations) {
    joints_at_begin.clear();
    for (Index j = 0; j < scene.joints.size(); ++j) {
      joints_at_begin.push_back(read_joint_state(scene, model, j));
    }
  }
}

Result<void> StepOutputs::end(const PhysicsScene& scene, const Steering& steering,
                              const Model& model) {
  if (wanted_.contacts) {
    read_contacts(scene, model);
  }
  if (wanted_.work || wanted_.efforts) {
    const Forces forces = forces_of_step(model);
    if (wanted_.efforts) {
      read_drives(model, forces);
    }
    if (wanted_.work) {
      add_work(scene, steering, model, forces);
    }
  }
  if (!wanted_.reactions && !wanted_.accelerations) {
    return {};
  }
  std::vector<double> acceleration(velocity_.size());
  for (std::size_t i = 0; i < acceleration.size(); ++i) {
    acceleration[i] = (model.data->qvel[i] - velocity_[i]) / model.model->opt.timestep;
  }
  return read_dynamics(scene, model, acceleration, velocity_);
}

Result<void> StepOutputs::at_rest(const PhysicsScene& scene, const Model& model) {
  const mjData& d = *model.data;
  if (wanted_.contacts) {
    read_contacts(scene, model);
  }
  drive_efforts.clear();
  for (const DriveMap& map : model.drives) {
    drive_efforts.push_back(map.actuator >= 0 ? d.actuator_force[map.actuator] : 0);
  }
  if (!wanted_.reactions && !wanted_.accelerations) {
    return {};
  }
  const auto nv = model.model->nv;
  return read_dynamics(scene, model, {d.qacc, d.qacc + nv}, {d.qvel, d.qvel + nv});
}

StepOutputs::Forces StepOutputs::forces_of_step(const Model& model) const {
  const mjModel& m = *model.model;
  const mjData& d = *model.data;
  const std::size_t nv = velocity_.size();
  const double dt = m.opt.timestep;
  Forces forces{std::vector<double>(nv), std::vector<double>(nv), std::vector<double>(nv)};
  std::vector<double> change(nv);
  std::vector<double> correction(nv);  // what the integrator added to the forces
  for (std::size_t i = 0; i < nv; ++i) {
    change[i] = (d.qvel[i] - velocity_[i]) / dt;
    forces.mean_velocity[i] = driven_[i] != 0 ? 0 : (d.qvel[i] + velocity_[i]) / 2;
  }
  mj_mulM(&m, &d, correction.data(), change.data());
  const bool implicit = damps_implicitly(m);
  for (std::size_t i = 0; i < nv; ++i) {
    correction[i] -= d.qfrc_smooth[i] + d.qfrc_constraint[i];
    forces.damping[i] = d.qfrc_damper[i] + d.qfrc_fluid[i];
    forces.drives[i] = d.qfrc_actuator[i];
    const double own = implicit ? -m.dof_damping[i] * change[i] * dt : 0;
    (drive_of_dof_[i] > 0 ? forces.drives[i] : forces.damping[i]) += correction[i] - own;
    forces.damping[i] += own;
  }
  return forces;
}

void StepOutputs::add_work(const PhysicsScene& scene, const Steering& steering, const Model& model,
                           const Forces& forces) {
  const mjModel& m = *model.model;
  const mjData& d = *model.data;
  const double dt = m.opt.timestep;
  const std::vector<double>& mean = forces.mean_velocity;
  work.drives += dt * dot_of(forces.drives.data(), mean);
  work.damping += dt * dot_of(forces.damping.data(), mean);
  work.applied += dt * dot_of(d.qfrc_applied, mean);
  double springs = dot_of(d.qfrc_spring, mean);
  for (int j = 0; j < m.njnt; ++j) {  // those that potential energy has
    if (m.jnt_type[j] == mjJNT_HINGE || m.jnt_type[j] == mjJNT_SLIDE) {
      const int q = m.jnt_qposadr[j];
      const double stretch = position_[static_cast<std::size_t>(q)] - m.qpos_spring[q];
      springs += m.jnt_stiffness[j] * stretch * mean[static_cast<std::size_t>(m.jnt_dofadr[j])];
    }
  }
  work.springs += dt * springs;
  std::vector<double> rows(static_cast<std::size_t>(d.nefc));
  if (!rows.empty()) {
    mj_mulJacVec(&m, &d, rows.data(), mean.data());
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const int type = d.efc_type[i];
    const bool touches = type == mjCNSTR_CONTACT_FRICTIONLESS ||
                         type == mjCNSTR_CONTACT_PYRAMIDAL || type == mjCNSTR_CONTACT_ELLIPTIC;
    (touches ? work.contacts : work.constraints) += dt * rows[i] * d.efc_force[i];
  }
  add_wrench_work(scene, steering, model, forces);
}

// Forces on bodies: what users set is applied, the gravity of further scenes is in the potential
// energy, and the rest damps.
void StepOutputs::add_wrench_work(const PhysicsScene& scene, const Steering& steering,
                                  const Model& model, const Forces& forces) {
  const mjModel& m = *model.model;
  const mjData& d = *model.data;
  const std::vector<Vec3d> gravity = steering.gravity_of(scene);
  std::vector<double> jacobian(6 * velocity_.size());
  for (Index b = 0; b < scene.bodies.size(); ++b) {
    const scene::Body& body = scene.bodies[b];
    const int id = model.bodies[b].id;
    const double* applied = d.xfrc_applied + std::ptrdiff_t{6} * id;
    if (body.kinematic || std::all_of(applied, applied + 6, [](double x) { return x == 0; })) {
      continue;
    }
    mj_jacBodyCom(&m, &d, jacobian.data(), jacobian.data() + 3 * velocity_.size(), id);
    const Vec3d linear = times(jacobian.data(), forces.mean_velocity);
    const Vec3d angular = times(jacobian.data() + 3 * velocity_.size(), forces.mean_velocity);
    Wrench set;
    const auto found = steering.wrenches.find(b);
    if (found != steering.wrenches.end()) {
      set = found->second;
    }
    const Wrench own = body_forces(body, model.bodies[b], d);
    set.force += own.force;
    set.torque += own.torque;
    const Vec3d other =
        read_vector(applied) - set.force - other_gravity(body, model.bodies[b].mass, gravity);
    const double dt = m.opt.timestep;
    work.applied += dt * (dot(set.force, linear) + dot(set.torque, angular));
    work.damping += dt * (dot(other, linear) + dot(read_vector(applied + 3) - set.torque, angular));
  }
}

void StepOutputs::read_contacts(const PhysicsScene& scene, const Model& model) {
  const mjModel& m = *model.model;
  const mjData& d = *model.data;
  contacts.clear();
  for (int i = 0; i < d.ncon; ++i) {
    const mjContact& found = d.contact[i];
    const int a = found.geom[0] < 0 ? -1 : model.collider_of_geom[std::size_t(found.geom[0])];
    const int b = found.geom[1] < 0 ? -1 : model.collider_of_geom[std::size_t(found.geom[1])];
    if (found.efc_address < 0 || a < 0 || b < 0) {
      continue;
    }
    double wrench[6];
    mj_contactForce(&m, &d, i, wrench);
    const bool swapped = a > b;
    const double sign = swapped ? -1 : 1;  // MuJoCo's is on the second geom
    Contact contact;
    contact.collider0 = static_cast<Index>(swapped ? b : a);
    contact.collider1 = static_cast<Index>(swapped ? a : b);
    contact.body0 = scene.colliders[contact.collider0].body;
    contact.body1 = scene.colliders[contact.collider1].body;
    contact.point = read_vector(found.pos);
    contact.normal = read_vector(found.frame) * sign;
    contact.depth = -found.dist;
    contact.normal_force = wrench[0];
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3d direction = read_vector(found.frame + std::ptrdiff_t{3} * axis) * sign;
      contact.friction_force += direction * (axis == 0 ? 0 : wrench[axis]);
      contact.friction_torque += direction * wrench[3 + axis];
    }
    contacts.push_back(contact);
  }
}

void StepOutputs::read_drives(const Model& model, const Forces& forces) {
  const mjData& d = *model.data;
  drive_efforts.clear();
  for (const DriveMap& map : model.drives) {
    if (map.actuator < 0) {
      drive_efforts.push_back(0);
      continue;
    }
    const auto dof = static_cast<std::size_t>(map.dof);
    const double correction = forces.drives[dof] - d.qfrc_actuator[dof];
    drive_efforts.push_back(d.actuator_force[map.actuator] + correction / drive_of_dof_[dof]);
  }
}

Result<void> StepOutputs::read_dynamics(const PhysicsScene& scene, const Model& model,
                                        const std::vector<double>& acceleration,
                                        const std::vector<double>& velocity) {
  const mjModel& m = *model.model;
  mjData& d = *model.data;
  const std::vector<double> own(d.qacc, d.qacc + m.nv);
  const std::vector<double> after(d.qvel, d.qvel + m.nv);
  std::copy(acceleration.begin(), acceleration.end(), d.qacc);
  std::copy(velocity.begin(), velocity.end(), d.qvel);
  {
    const LiftedBodies lifted(m, d);
    TENON_CHECK(guarded([&] { mj_rnePostConstraint(&m, &d); }));
  }
  std::copy(own.begin(), own.end(), d.qacc);
  std::copy(after.begin(), after.end(), d.qvel);
  reactions.clear();
  for (const JointCarriers& carriers : carriers_) {
    reactions.push_back(joint_reaction(scene, model, carriers));
  }
  bodies.clear();
  const bool falls = (m.opt.disableflags & mjDSBL_GRAVITY) == 0;
  for (std::size_t b = 0; wanted_.accelerations && b < model.bodies.size(); ++b) {
    double values[6];
    mj_objectAcceleration(&m, &d, mjOBJ_BODY, model.bodies[b].id, values, 0);
    // MuJoCo's is what an accelerometer shows.
    const Vec3d gravity = falls ? read_vector(m.opt.gravity) : Vec3d{};
    bodies.push_back({read_vector(values + 3) + gravity, read_vector(values)});
  }
  return {};
}

}  // namespace tenon::engines::mujoco
