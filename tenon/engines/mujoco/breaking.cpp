// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "tenon/engines/mujoco/build.h"
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/mujoco/mujoco_simulation.h"

// Joints break when what they carry exceeds their limits (S-93). In the tree that is the force
// between a body and its parent, drives and limits included; a loop is carried by its equality
// constraints, a distance by its tendons.
namespace tenon::engines::mujoco {
namespace {

using physics::Index;

// MuJoCo's rows of a weld turn with half the angular velocity.
constexpr double kWeldTorque = 0.5;

std::vector<int> ids(const mjModel* m, mjtObj kind, const std::string& name,
                     std::initializer_list<const char*> suffixes) {
  std::vector<int> found;
  for (const char* suffix : suffixes) {
    const int id = mj_name2id(m, kind, (name + suffix).c_str());
    if (id >= 0) {
      found.push_back(id);
    }
  }
  return found;
}

/// Forces of the rows of one constraint, in row order.
std::vector<double> rows_of(const mjData& d, mjtConstraint type, int id) {
  std::vector<double> forces;
  for (int i = 0; i < d.nefc; ++i) {
    if (d.efc_type[i] == type && d.efc_id[i] == id) {
      forces.push_back(d.efc_force[i]);
    }
  }
  return forces;
}

Vec3d three(const std::vector<double>& rows, std::size_t first) {
  return rows.size() >= first + 3 ? Vec3d{{rows[first], rows[first + 1], rows[first + 2]}}
                                  : Vec3d{};
}

}  // namespace

void MujocoSimulation::collect_breakable() {
  breakable_.clear();
  if (own_ == nullptr) {
    return;
  }
  const mjModel* m = model_.model.get();
  for (Index j = 0; j < own_->joints.size(); ++j) {
    const physics::Joint& joint = own_->joints[j];
    const bool can_break =
        joint.break_force < physics::kUnlimited || joint.break_torque < physics::kUnlimited;
    if (!can_break || !joint.enabled) {
      continue;
    }
    Breakable breakable;
    breakable.joint = j;
    const std::string name = joint.path.str();
    breakable.equalities = ids(m, mjOBJ_EQUALITY, name, {"", ".loop", ".a", ".b"});
    breakable.tendons = ids(m, mjOBJ_TENDON, name, {".distance.max", ".distance.min"});
    breakable.cone = mj_name2id(m, mjOBJ_TENDON, (name + ".cone").c_str());
    for (std::size_t b = 0; b < model_.plan.bodies.size(); ++b) {
      const BodyPlan& plan = model_.plan.bodies[b];
      if (plan.base == BodyBase::Jointed && plan.joint == j) {
        breakable.child = model_.bodies[b].id;
      }
    }
    breakable.arm = hinge_arm(*own_, joint);
    breakable_.push_back(std::move(breakable));
  }
}

// A cone pulls the tip of the child's axis toward that of the parent's: MuJoCo counts the pull as
// external to the joint, here it is part of what the joint carries.
void MujocoSimulation::load_of_cone(const Breakable& breakable, Vec3d& force, Vec3d& torque) const {
  const physics::Joint& joint = own_->joints[breakable.joint];
  const Vec3d tip = unit_axis(joint.axis) * breakable.arm;
  const Pose frame0 = frame_in_world(joint.body0, joint.frame0);
  const Pose frame1 = frame_in_world(joint.body1, joint.frame1);
  const bool reversed = model_.joints[breakable.joint].reversed;
  const Pose& parent = reversed ? frame1 : frame0;
  const Pose& child = reversed ? frame0 : frame1;
  const Vec3d arm = rotate(child.orientation, tip);
  const Vec3d apart = parent.position + rotate(parent.orientation, tip) - child.position - arm;
  const double distance = length(apart);
  for (const double size : rows_of(*model_.data, mjCNSTR_LIMIT_TENDON, breakable.cone)) {
    const Vec3d pull = distance > 0 ? apart * (size / distance) : Vec3d{};
    force += pull;
    torque += cross(arm, pull);
  }
}

// Force and torque about the anchor, world axes, in the step that was just made; MuJoCo's derived
// quantities still are those of its beginning.
void MujocoSimulation::load_on(const Breakable& breakable, Vec3d& force, Vec3d& torque) const {
  const mjModel& m = *model_.model;
  const mjData& d = *model_.data;
  const physics::Joint& joint = own_->joints[breakable.joint];
  if (breakable.child >= 0) {
    const double* wrench = d.cfrc_int + 6 * breakable.child;
    force = read_vector(wrench + 3);
    const Vec3d center = read_vector(d.subtree_com + 3 * m.body_rootid[breakable.child]);
    const Vec3d anchor = frame_in_world(joint.body1, joint.frame1).position;
    torque = read_vector(wrench) + cross(center - anchor, force);
  }
  if (breakable.cone >= 0) {
    load_of_cone(breakable, force, torque);
  }
  std::vector<Vec3d> points;
  for (const int equality : breakable.equalities) {
    const std::vector<double> rows = rows_of(d, mjCNSTR_EQUALITY, equality);
    points.push_back(three(rows, 0));
    force += points.back();
    torque += three(rows, 3) * kWeldTorque;
  }
  if (points.size() == 2) {  // the two points of a hinge
    const Pose frame = frame_in_world(joint.body0, joint.frame0);
    const Vec3d arm = rotate(frame.orientation, unit_axis(joint.axis)) * breakable.arm;
    torque += cross(arm, points[0] - points[1]);
  }
  for (const int tendon : breakable.tendons) {
    for (const double pull : rows_of(d, mjCNSTR_LIMIT_TENDON, tendon)) {
      force += Vec3d{{pull, 0, 0}};  // along the tendon; only its size counts
    }
  }
}

Result<void> MujocoSimulation::break_joints() {
  mjModel* m = model_.model.get();
  mjData* d = model_.data.get();
  TENON_CHECK(guarded([&] { mj_rnePostConstraint(m, d); }));
  bool any = false;
  for (const Breakable& breakable : breakable_) {
    physics::Joint& joint = own_->joints[breakable.joint];
    Vec3d force;
    Vec3d torque;
    load_on(breakable, force, torque);
    if (length(force) <= joint.break_force && length(torque) <= joint.break_torque) {
      continue;
    }
    char what[96];
    std::snprintf(what, sizeof what, "broke under %.4g N and %.4g N m", length(force),
                  length(torque));
    events_.push_back({d->time, joint.path, what});
    joint.enabled = false;
    broken_[breakable.joint] = 1;
    any = true;
  }
  return any ? rebuild() : Result<void>();
}

}  // namespace tenon::engines::mujoco
