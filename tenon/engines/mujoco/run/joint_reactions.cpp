// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// In the tree a joint carries the force between a body and its parent, drives and limits included,
// which MuJoCo gives as that of the parent on the child about the centre of mass of the whole tree.
// A loop is carried by equality constraints, whose rows push the first of their two sites, on body
// 0; body 1 gets the opposite. A distance is carried by tendons along the line between the anchors.
#include "tenon/engines/mujoco/run/joint_reactions.h"

#include <cstddef>
#include <string>

#include "tenon/engines/mujoco/build/build.h"
#include "tenon/engines/mujoco/run/read_state.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Index;

// MuJoCo's rows of a weld turn with half the angular velocity.
constexpr double kWeldTorque = 0.5;

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

double sum_of(const mjData& d, int tendon) {
  double sum = 0;
  for (const double row : rows_of(d, mjCNSTR_LIMIT_TENDON, tendon)) {
    sum += row;
  }
  return sum;
}

struct Frames {
  Pose side0;  // joint frames in the world
  Pose side1;
};

// A cone pulls the tip of the child's axis toward that of the parent's: MuJoCo counts the pull as
// external to the joint, here it is part of what the joint carries.
Wrench cone_pull(const scene::Joint& joint, const Model& model, const JointCarriers& carriers,
                 const Frames& frames) {
  const Vec3d tip = unit_axis(joint.axis) * carriers.arm;
  const Vec3d arm = rotate(frames.side1.orientation, tip);
  const Vec3d apart =
      frames.side0.position + rotate(frames.side0.orientation, tip) - frames.side1.position - arm;
  const double distance = length(apart);
  if (!(distance > 0)) {
    return {};
  }
  const Vec3d pull = apart * (sum_of(*model.data, carriers.cone) / distance);
  return {pull, cross(arm, pull)};
}

Wrench tree_wrench(const Model& model, const JointCarriers& carriers, const Frames& frames) {
  const mjModel& m = *model.model;
  const mjData& d = *model.data;
  const double* wrench = d.cfrc_int + std::ptrdiff_t{6} * carriers.child;
  const double sign = carriers.reversed ? -1 : 1;  // the child is body 0
  const Vec3d force = read_vector(wrench + 3);
  const Vec3d center =
      read_vector(d.subtree_com + std::ptrdiff_t{3} * m.body_rootid[carriers.child]);
  const Vec3d torque = read_vector(wrench) + cross(center - frames.side1.position, force);
  return {force * sign, torque * sign};
}

Wrench loop_wrench(const scene::Joint& joint, const Model& model, const JointCarriers& carriers,
                   const Frames& frames) {
  Wrench result;
  const Vec3d arm = rotate(frames.side1.orientation, unit_axis(joint.axis)) * carriers.arm;
  for (std::size_t i = 0; i < carriers.equalities.size(); ++i) {
    const std::vector<double> rows = rows_of(*model.data, mjCNSTR_EQUALITY, carriers.equalities[i]);
    const Vec3d force = -three(rows, 0);
    result.force += force;
    result.torque -= rotate(frames.side1.orientation, three(rows, 3)) * kWeldTorque;
    if (carriers.equalities.size() == 2) {  // the two points of a hinge
      result.torque += cross(i == 0 ? arm : -arm, force);
    }
  }
  return result;
}

Vec3d distance_force(const Model& model, const JointCarriers& carriers, const Frames& frames) {
  const Vec3d apart = frames.side1.position - frames.side0.position;
  const double push = (carriers.tendon_min >= 0 ? sum_of(*model.data, carriers.tendon_min) : 0) -
                      (carriers.tendon_max >= 0 ? sum_of(*model.data, carriers.tendon_max) : 0);
  return length(apart) > 0 ? normalized(apart) * push : Vec3d{};
}

int find(const mjModel* m, mjtObj kind, const std::string& name) {
  return mj_name2id(m, kind, name.c_str());
}

}  // namespace

std::vector<JointCarriers> find_carriers(const scene::PhysicsScene& scene, const Model& model) {
  const mjModel* m = model.model.get();
  std::vector<JointCarriers> result(scene.joints.size());
  for (Index j = 0; j < scene.joints.size(); ++j) {
    const std::string name = scene.joints[j].path.str();
    JointCarriers& carriers = result[j];
    carriers.joint = j;
    for (const char* suffix : {"", ".loop", ".a", ".b"}) {
      const int id = find(m, mjOBJ_EQUALITY, name + suffix);
      if (id >= 0) {
        carriers.equalities.push_back(id);
      }
    }
    carriers.tendon_max = find(m, mjOBJ_TENDON, name + ".distance.max");
    carriers.tendon_min = find(m, mjOBJ_TENDON, name + ".distance.min");
    carriers.cone = find(m, mjOBJ_TENDON, name + ".cone");
    const scene::Joint& joint = scene.joints[j];
    if (joint.body0.has_value() || joint.body1.has_value()) {
      carriers.arm = hinge_arm(scene, joint);
    }
  }
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const scene::ForestBody& link = model.plan.forest.bodies[b];
    if (link.joint) {
      result[*link.joint].child = model.bodies[b].id;
      result[*link.joint].reversed = link.reversed;
    }
  }
  return result;
}

Wrench joint_reaction(const scene::PhysicsScene& scene, const Model& model,
                      const JointCarriers& carriers) {
  const scene::Joint& joint = scene.joints[carriers.joint];
  const Frames frames{frame_in_world(model, joint.body0, joint.frame0),
                      frame_in_world(model, joint.body1, joint.frame1)};
  Wrench result;
  if (carriers.child >= 0) {
    result = tree_wrench(model, carriers, frames);
  }
  if (carriers.cone >= 0) {
    const Wrench cone = cone_pull(joint, model, carriers, frames);
    result.force += cone.force;
    result.torque += cone.torque;
  }
  const Wrench loop = loop_wrench(joint, model, carriers, frames);
  result.force += loop.force + distance_force(model, carriers, frames);
  result.torque += loop.torque;
  return result;
}

}  // namespace tenon::engines::mujoco
