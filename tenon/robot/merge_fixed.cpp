// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Links go down the tree: each is either kept or added to the kept one above it, with its pose
// there. All references to links and joints by number are renumbered at the end.
#include "tenon/robot/merge_fixed.h"

#include "tenon/math/inertia.h"

namespace tenon::robot {
namespace {

Mat3d sum(Mat3d a, const Mat3d& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      a[i][j] += b[i][j];
    }
  }
  return a;
}

template <class Shape>
void take_shapes(const std::vector<Shape>& from, const Pose& pose, std::vector<Shape>& to) {
  for (Shape shape : from) {
    shape.pose = pose * shape.pose;
    to.push_back(std::move(shape));
  }
}

struct Host {
  Index link = 0;  // in the result
  Pose pose;       // of the merged link in it
};

void renumber(const std::vector<Host>& hosts, MujocoTracking& tracking) {
  if (tracking.target) {
    tracking.target = hosts[*tracking.target].link;
  }
}

void move_loops(const std::vector<Host>& hosts, RobotModel& result) {
  for (LoopJoint& loop : result.loops) {
    for (std::size_t side = 0; side < 2; ++side) {
      const Host& host = hosts[loop.links[side]];
      loop.links[side] = host.link;
      loop.frames[side] = host.pose * loop.frames[side];
    }
  }
}

/// `number`: of the joints. None of MuJoCo's parts is about a fixed one, which has no coordinate.
void renumber(const std::vector<Index>& number, MujocoParts& parts) {
  for (MujocoTendon& tendon : parts.tendons) {
    for (Index& joint : tendon.joints) {
      joint = number[joint];
    }
  }
  for (MujocoActuator& actuator : parts.actuators) {
    if (actuator.kind == MujocoActuator::Target::Joint) {
      actuator.target = number[actuator.target];
    }
  }
}

// What is fixed to a link becomes part of it.
void add_part(const Link& part, const Pose& pose, Link& whole) {
  if (part.inertial) {
    const Inertial moved = placed(*part.inertial, pose);
    whole.inertial = whole.inertial ? sum_inertials(*whole.inertial, moved) : moved;
  }
  take_shapes(part.visuals, pose, whole.visuals);
  take_shapes(part.colliders, pose, whole.colliders);
  take_shapes(part.sites, pose, whole.sites);
  take_shapes(part.cameras, pose, whole.cameras);
  take_shapes(part.lights, pose, whole.lights);
}

// Gives the result the links that stay, with their parts; where each link of the model is then.
std::vector<Host> merge_links(const RobotModel& model, const KinematicTree& tree,
                              RobotModel& result) {
  std::vector<Host> hosts(model.links.size());
  for (const Index link : tree.order) {
    const std::optional<Index> above = tree.joint_to_parent[link];
    if (!above || model.joints[*above].kind != JointKind::Fixed) {
      hosts[link].link = static_cast<Index>(result.links.size());
      result.links.push_back(model.links[link]);
      continue;
    }
    const Joint& joint = model.joints[*above];
    const Host& parent = hosts[joint.parent];
    hosts[link] = {parent.link, parent.pose * joint.origin};
    add_part(model.links[link], hosts[link].pose, result.links[parent.link]);
  }
  return hosts;
}

// Gives the result the joints that move, between the links that stay; the new number of each.
std::vector<Index> keep_moving_joints(const RobotModel& model, const std::vector<Host>& hosts,
                                      RobotModel& result) {
  std::vector<Index> number(model.joints.size(), 0);
  for (Index i = 0; i < model.joints.size(); ++i) {
    if (model.joints[i].kind != JointKind::Fixed) {
      Joint joint = model.joints[i];
      joint.origin = hosts[joint.parent].pose * joint.origin;
      joint.parent = hosts[joint.parent].link;
      joint.child = hosts[joint.child].link;
      number[i] = static_cast<Index>(result.joints.size());
      result.joints.push_back(std::move(joint));
    }
  }
  for (Joint& joint : result.joints) {
    if (joint.mimic) {
      joint.mimic->leader = number[joint.mimic->leader];
    }
  }
  return number;
}

}  // namespace

Inertial placed(const Inertial& inertial, const Pose& pose) {
  Inertial result = inertial;
  result.center_of_mass = transform_point(pose, inertial.center_of_mass);
  result.axes = pose.orientation * inertial.axes;
  return result;
}

Inertial sum_inertials(const Inertial& a, const Inertial& b) {
  Inertial result;
  result.place = a.place;
  result.mass = a.mass + b.mass;
  result.center_of_mass =
      result.mass > 0 ? (a.center_of_mass * a.mass + b.center_of_mass * b.mass) * (1 / result.mass)
                      : a.center_of_mass;
  for (const Inertial* part : {&a, &b}) {
    result.inertia =
        sum(result.inertia, shift_inertia(part->inertia_in_link(), part->mass,
                                          part->center_of_mass - result.center_of_mass));
  }
  return result;
}

RobotModel merge_fixed(const RobotModel& model, const KinematicTree& tree) {
  RobotModel result = model;
  result.links.clear();
  result.joints.clear();
  const std::vector<Host> hosts = merge_links(model, tree, result);
  for (std::array<Index, 2>& pair : result.excluded_pairs) {
    pair = {hosts[pair[0]].link, hosts[pair[1]].link};
  }
  move_loops(hosts, result);
  for (Link& link : result.links) {
    for (Camera& camera : link.cameras) {
      renumber(hosts, camera.tracking);
    }
    for (Light& light : link.lights) {
      renumber(hosts, light.tracking);
    }
  }
  renumber(keep_moving_joints(model, hosts, result), result.mujoco);
  return result;
}

}  // namespace tenon::robot
