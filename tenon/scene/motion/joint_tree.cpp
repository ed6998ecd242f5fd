// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Vectors are taken from the middle of the bodies of a group, so that a scene far from the origin
// of the world loses no digits.
#include "tenon/scene/motion/joint_tree.h"

#include <algorithm>
#include <cmath>

#include "tenon/base/containers/disjoint_sets.h"
#include "tenon/math/inertia.h"
#include "tenon/math/mimic_law.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::scene {
namespace {

/// Bodies connected by joints and mimics: for each body the representative of its group.
DisjointSets sets_of_groups(const PhysicsScene& scene, const JointForest& forest) {
  DisjointSets sets(scene.bodies.size());
  const auto any_side = [&](Index j) {
    const Joint& joint = scene.joints[j];
    return joint.body0 ? joint.body0 : joint.body1;
  };
  for (Index j = 0; j < scene.joints.size(); ++j) {
    const Joint& joint = scene.joints[j];
    if (forest.joints[j] == ForestRole::None) {
      continue;
    }
    if (joint.body0 && joint.body1) {
      sets.join(*joint.body0, *joint.body1);
    }
    for (const Mimic& mimic : joint.mimics) {
      if (any_side(j) && any_side(mimic.leader)) {
        sets.join(*any_side(j), *any_side(mimic.leader));
      }
    }
  }
  return sets;
}

}  // namespace

bool holds(const Joint& joint) {
  return joint.kind != JointKind::Distance && !(joint.kind == JointKind::D6 && is_plain(joint));
}

std::vector<JointGroup> joint_groups(const PhysicsScene& scene, const JointForest& forest) {
  DisjointSets sets = sets_of_groups(scene, forest);
  std::map<std::size_t, JointGroup> groups;
  for (Index j = 0; j < scene.joints.size(); ++j) {
    const Joint& joint = scene.joints[j];
    if (forest.joints[j] != ForestRole::None && (joint.body0 || joint.body1)) {
      groups[sets.find(joint.body0 ? *joint.body0 : *joint.body1)].joints.push_back(j);
    }
  }
  for (const Index body : forest.order) {
    const auto group = groups.find(sets.find(body));
    if (group != groups.end()) {
      group->second.bodies.push_back(body);
    }
  }
  std::vector<JointGroup> result;
  for (auto& [set, group] : groups) {
    result.push_back(std::move(group));
  }
  return result;
}

JointTree::JointTree(const PhysicsScene& scene, const JointForest& forest,
                     const std::vector<JointDofs>& dofs, const std::vector<Pose>& poses,
                     const JointGroup& group, const JointTreeOptions& options)
    : scene_(scene),
      forest_(forest),
      dofs_(dofs),
      poses_(poses),
      options_(options),
      bodies_(group.bodies) {
  for (std::size_t m = 0; m < bodies_.size(); ++m) {
    member_of_[bodies_[m]] = m;
    origin_ += poses[bodies_[m]].position * (1.0 / static_cast<double>(bodies_.size()));
  }
  for (std::size_t m = 0; m < bodies_.size(); ++m) {
    const ForestBody& link = forest_.bodies[bodies_[m]];
    tree_.parents.push_back(link.parent ? member_of_.at(*link.parent) : MotionTree::kNone);
    tree_.inertias.push_back(inertia_of(bodies_[m]));
    add_columns(m);
  }
  tree_.given.assign(tree_.members.size(), 0);
  add_rows(group.joints);
}

Vec3d JointTree::center_of(Index body) const {
  return transform_point(poses_[body], scene_.bodies[body].center_of_mass) - origin_;
}

Pose JointTree::frame_of(const std::optional<Index>& body, const Pose& frame) const {
  Pose result = body ? poses_[*body] * frame : frame;
  result.position -= origin_;
  return result;
}

JointMotion JointTree::motion_of(Index joint) const {
  const Joint& j = scene_.joints[joint];
  return joint_motion(dofs_[joint], frame_of(j.body0, j.frame0), frame_of(j.body1, j.frame1));
}

Mat3d JointTree::inertia_about_center(Index body) const {
  Mat3d inertia = rotate_inertia(poses_[body].orientation, scene_.bodies[body].inertia);
  for (std::size_t i = 0; i < 3; ++i) {
    inertia[i][i] += options_.least_moment;
  }
  return inertia;
}

RigidInertia JointTree::inertia_of(Index body) const {
  RigidInertia result;
  if (!scene_.bodies[body].kinematic) {
    const Vec3d center = center_of(body);
    result.mass = std::max(scene_.bodies[body].mass, options_.least_mass);
    result.moment = center * result.mass;
    result.inertia = shift_inertia(inertia_about_center(body), result.mass, center);
  }
  return result;
}

std::optional<std::size_t> JointTree::member_at(const std::optional<Index>& body) const {
  return body ? std::optional(member_of_.at(*body)) : std::nullopt;
}

void JointTree::add_columns(std::size_t member) {
  const Index body = bodies_[member];
  const ForestBody& link = forest_.bodies[body];
  const auto add = [&](const Screw& screw) {
    tree_.members.push_back(member);
    tree_.screws.push_back(screw);
  };
  if (!link.joint) {
    for (int i = 0; !scene_.bodies[body].kinematic && i < 6; ++i) {
      const Vec3d axis = unit_axis(static_cast<Axis>(i % 3));
      add(i < 3 ? Screw{{}, axis} : turn_about(center_of(body), axis));
    }
    return;
  }
  const JointMotion motion = motion_of(*link.joint);
  const double sign = link.reversed ? -1 : 1;
  first_column_[*link.joint] = tree_.members.size();
  for (const Vec3d& axis : motion.slides) {
    add(Screw{{}, axis} * sign);
  }
  for (const Vec3d& axis : motion.turns) {
    add(turn_about(motion.point, axis) * sign);
  }
}

// ---- rows

// The speed that a unit impulse gives to a body alone.
double JointTree::response(const std::optional<std::size_t>& member, const Screw& impulse) const {
  if (!member || scene_.bodies[bodies_[*member]].kinematic) {
    return 0;
  }
  const Index body = bodies_[*member];
  const Vec3d twist = impulse.turn - cross(center_of(body), impulse.move);
  return dot(impulse.move, impulse.move) / tree_.inertias[*member].mass +
         dot(twist, twist * inverse(inertia_about_center(body)));
}

std::vector<LoopRow> JointTree::rows_of(Index joint) const {
  const Joint& j = scene_.joints[joint];
  const JointMotion motion = motion_of(joint);
  std::vector<LoopRow> rows;
  const auto add = [&](const Screw& impulse) {
    LoopRow row{joint, member_at(j.body0), member_at(j.body1), impulse, 1};
    const double speed = response(row.member0, impulse) + response(row.member1, impulse);
    row.size = speed > 0 ? 1 / std::sqrt(speed) : 0;
    rows.push_back(row);
  };
  for (const Vec3d& axis : directions_across(motion.slides)) {
    add({cross(motion.point, axis), axis});
  }
  for (const Vec3d& axis : directions_across(motion.turns)) {
    add({axis, {}});
  }
  return rows;
}

void JointTree::add_rows(const std::vector<Index>& joints) {
  for (const Index joint : joints) {
    if (forest_.joints[joint] == ForestRole::Loop && holds(scene_.joints[joint])) {
      const std::vector<LoopRow> rows = rows_of(joint);
      loops_.rows.insert(loops_.rows.end(), rows.begin(), rows.end());
    }
    for (const Mimic& mimic : scene_.joints[joint].mimics) {
      add_mimic(joint, mimic);
    }
  }
}

std::optional<std::size_t> JointTree::column_of(Index joint, Dof dof) const {
  const auto first = first_column_.find(joint);
  for (std::size_t i = 0; first != first_column_.end() && i < dofs_[joint].free.size(); ++i) {
    if (dofs_[joint].free[i].dof == dof) {
      return first->second + i;
    }
  }
  return std::nullopt;
}

// Speed of the follower by that of the leader.
double JointTree::slope_of(const Mimic& mimic) const {
  const Joint& leader = scene_.joints[mimic.leader];
  const Pose relative =
      inverse(frame_of(leader.body0, leader.frame0)) * frame_of(leader.body1, leader.frame1);
  const std::vector<double> all = coordinates_at(dofs_[mimic.leader], relative);
  double at = 0;
  for (std::size_t i = 0; i < dofs_[mimic.leader].free.size(); ++i) {
    at = dofs_[mimic.leader].free[i].dof == mimic.leader_dof ? all[i] : at;
  }
  return mimic_slope(mimic, at);
}

void JointTree::add_mimic(Index joint, const Mimic& mimic) {
  const auto follower = column_of(joint, mimic.dof);
  const auto leader = column_of(mimic.leader, mimic.leader_dof);
  const bool rigid = mimic.natural_frequency == 0 && mimic.parts.mujoco.solref.empty();
  if (!follower || !leader || (!rigid && options_.mimics == TiedMimics::Rigid)) {
    return;
  }
  SpeedRow row{*follower, *leader, slope_of(mimic), 1};
  const std::size_t member = tree_.members[row.follower];
  const double inertia =
      dot(tree_.screws[row.follower], tree_.inertias[member].momentum(tree_.screws[row.follower]));
  row.size = inertia > 0 ? std::sqrt(inertia) : 1;
  loops_.speed_rows.push_back(row);
}

}  // namespace tenon::scene
