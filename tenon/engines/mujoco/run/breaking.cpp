// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Joints break when what they carry exceeds their limits (S-93). In the tree that is the force
// between a body and its parent, drives and limits included; a loop is carried by its equality
// constraints, a distance by its tendons.
#include "tenon/engines/mujoco/run/breaking.h"

#include <string>
#include <utility>

#include "tenon/engines/mujoco/build/build.h"
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/mujoco/run/read_state.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Index;

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

Breaking::Breaking(const scene::PhysicsScene& scene, const Model& model) {
  const mjModel* m = model.model.get();
  for (Index j = 0; j < scene.joints.size(); ++j) {
    const scene::Joint& joint = scene.joints[j];
    if (!scene::can_break(joint) || !joint.enabled) {
      continue;
    }
    Breakable breakable;
    breakable.joint = j;
    const std::string name = joint.path.str();
    breakable.equalities = ids(m, mjOBJ_EQUALITY, name, {"", ".loop", ".a", ".b"});
    breakable.tendons = ids(m, mjOBJ_TENDON, name, {".distance.max", ".distance.min"});
    breakable.cone = mj_name2id(m, mjOBJ_TENDON, (name + ".cone").c_str());
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      if (model.plan.forest.bodies[b].joint == j) {
        breakable.child = model.bodies[b].id;
      }
    }
    breakable.arm = hinge_arm(scene, joint);
    breakable_.push_back(std::move(breakable));
  }
}

// A cone pulls the tip of the child's axis toward that of the parent's: MuJoCo counts the pull as
// external to the joint, here it is part of what the joint carries.
JointLoad Breaking::load_of_cone(const scene::PhysicsScene& scene, const Model& model,
                                 const Breakable& breakable) {
  JointLoad load;
  const scene::Joint& joint = scene.joints[breakable.joint];
  const Vec3d tip = unit_axis(joint.axis) * breakable.arm;
  const Pose frame0 = frame_in_world(model, joint.body0, joint.frame0);
  const Pose frame1 = frame_in_world(model, joint.body1, joint.frame1);
  const bool reversed = model.joints[breakable.joint].reversed;
  const Pose& parent = reversed ? frame1 : frame0;
  const Pose& child = reversed ? frame0 : frame1;
  const Vec3d arm = rotate(child.orientation, tip);
  const Vec3d apart = parent.position + rotate(parent.orientation, tip) - child.position - arm;
  const double distance = length(apart);
  for (const double size : rows_of(*model.data, mjCNSTR_LIMIT_TENDON, breakable.cone)) {
    const Vec3d pull = distance > 0 ? apart * (size / distance) : Vec3d{};
    load.force += pull;
    load.torque += cross(arm, pull);
  }
  return load;
}

// Force and torque about the anchor, world axes, in the step that was just made; MuJoCo's derived
// quantities still are those of its beginning.
JointLoad Breaking::load_on(const scene::PhysicsScene& scene, const Model& model,
                            const Breakable& breakable) {
  const mjModel& m = *model.model;
  const mjData& d = *model.data;
  const scene::Joint& joint = scene.joints[breakable.joint];
  JointLoad load;
  if (breakable.child >= 0) {
    const double* wrench = d.cfrc_int + 6 * breakable.child;
    load.force = read_vector(wrench + 3);
    const Vec3d center = read_vector(d.subtree_com + 3 * m.body_rootid[breakable.child]);
    const Vec3d anchor = frame_in_world(model, joint.body1, joint.frame1).position;
    load.torque = read_vector(wrench) + cross(center - anchor, load.force);
  }
  if (breakable.cone >= 0) {
    const JointLoad cone = load_of_cone(scene, model, breakable);
    load.force += cone.force;
    load.torque += cone.torque;
  }
  std::vector<Vec3d> points;
  for (const int equality : breakable.equalities) {
    const std::vector<double> rows = rows_of(d, mjCNSTR_EQUALITY, equality);
    points.push_back(three(rows, 0));
    load.force += points.back();
    load.torque += three(rows, 3) * kWeldTorque;
  }
  if (points.size() == 2) {  // the two points of a hinge
    const Pose frame = frame_in_world(model, joint.body0, joint.frame0);
    const Vec3d arm = rotate(frame.orientation, unit_axis(joint.axis)) * breakable.arm;
    load.torque += cross(arm, points[0] - points[1]);
  }
  for (const int tendon : breakable.tendons) {
    for (const double pull : rows_of(d, mjCNSTR_LIMIT_TENDON, tendon)) {
      load.force += Vec3d{{pull, 0, 0}};  // along the tendon; only its size counts
    }
  }
  return load;
}

Result<std::vector<Breaking::Broken>> Breaking::broken(const scene::PhysicsScene& scene,
                                                       const Model& model) const {
  TENON_CHECK(guarded([&] { mj_rnePostConstraint(model.model.get(), model.data.get()); }));
  std::vector<Broken> broken;
  for (const Breakable& breakable : breakable_) {
    const scene::Joint& joint = scene.joints[breakable.joint];
    const JointLoad load = load_on(scene, model, breakable);
    const bool holds =
        length(load.force) <= joint.break_force && length(load.torque) <= joint.break_torque;
    if (!holds) {
      broken.push_back({breakable.joint, load});
    }
  }
  return broken;
}

}  // namespace tenon::engines::mujoco
