// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Gauss's principle for impulses: among the velocities v that joints allow, the impulses of joints
// choose the one with the least (v - v0)^T M (v - v0). With v = base + J q, where base is the
// motion that is prescribed, that is M_q q = J^T M (v0 - base), the momentum along each coordinate.
// What closes a loop adds rows A v = 0, whose impulses loop_impulses.cpp finds.
// Joints that hang together, over loops and mimics too, are one group; a group at rest is passed
// over and a body without joints keeps its velocity as it is.
#include "tenon/scene/motion/fit_velocities.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

#include "tenon/math/inertia.h"
#include "tenon/scene/disjoint_sets.h"
#include "tenon/scene/joint_freedom.h"
#include "tenon/scene/motion/joint_motion.h"
#include "tenon/scene/motion/loop_impulses.h"
#include "tenon/scene/motion/tree_inertia.h"

namespace tenon::scene {
namespace {

constexpr double kLeastMass = 1e-9;     // [kg] of a body without mass
constexpr double kLeastMoment = 1e-13;  // [kg m^2]
constexpr double kNoticedLoss = 1e-4;   // of the energy

bool is_moving(const BodyState& state) {
  return state.linear_velocity != Vec3d{} || state.angular_velocity != Vec3d{};
}

bool holds(const Joint& j) {
  return j.kind != JointKind::Distance && !(j.kind == JointKind::D6 && is_plain(j));
}

/// Bodies and joints of a group, seen from its origin.
struct Places {
  const PhysicsScene& scene;
  const std::vector<JointDofs>& dofs;
  const std::vector<BodyState>& states;
  Vec3d origin;  // of all vectors, in the world

  Vec3d center_of(Index body) const {
    return transform_point(states[body].pose, scene.bodies[body].center_of_mass) - origin;
  }

  Pose frame_of(const std::optional<Index>& body, const Pose& frame) const {
    Pose result = body ? states[*body].pose * frame : frame;
    result.position -= origin;
    return result;
  }

  JointMotion motion_of(Index joint) const {
    const Joint& j = scene.joints[joint];
    return joint_motion(dofs[joint], frame_of(j.body0, j.frame0), frame_of(j.body1, j.frame1));
  }

  Mat3d inertia_about_center(Index body) const {
    Mat3d inertia = rotate_inertia(states[body].pose.orientation, scene.bodies[body].inertia);
    for (std::size_t i = 0; i < 3; ++i) {
      inertia[i][i] += kLeastMoment;
    }
    return inertia;
  }

  RigidInertia inertia_of(Index body) const {
    RigidInertia result;
    if (!scene.bodies[body].kinematic) {
      const Vec3d center = center_of(body);
      result.mass = std::max(scene.bodies[body].mass, kLeastMass);
      result.moment = center * result.mass;
      result.inertia = shift_inertia(inertia_about_center(body), result.mass, center);
    }
    return result;
  }

  double coordinate(Index joint, Dof dof) const {
    const Joint& j = scene.joints[joint];
    const Pose relative = inverse(frame_of(j.body0, j.frame0)) * frame_of(j.body1, j.frame1);
    const std::vector<double> all = coordinates_at(dofs[joint], relative);
    for (std::size_t i = 0; i < dofs[joint].free.size(); ++i) {
      if (dofs[joint].free[i].dof == dof) {
        return all[i];
      }
    }
    return 0;
  }
};

class Group {
 public:
  Group(const PhysicsScene& scene, const JointForest& forest, const std::vector<JointDofs>& dofs,
        const std::vector<BodyState>& states, LinkVelocities links)
      : scene_(scene),
        forest_(forest),
        dofs_(dofs),
        states_(states),
        places_{scene, dofs, states, {}},
        links_(links) {}

  void add_body(Index body) {
    member_of_[body] = bodies_.size();
    bodies_.push_back(body);
  }
  void add_joint(Index joint) { joints_.push_back(joint); }

  void solve(FittedVelocities& result) {
    if (!moves()) {
      return;
    }
    for (const Index body : bodies_) {
      places_.origin += states_[body].pose.position * (1.0 / static_cast<double>(bodies_.size()));
    }
    add_members();
    add_rows();
    std::vector<double> speeds = nearest_speeds();
    close_loops(tree_, *inertia_, loops_, base_, given_speeds_, speeds);
    const std::vector<Screw> moved = tree_.motions(speeds);
    for (std::size_t m = 0; m < bodies_.size(); ++m) {
      motion_.push_back(base_[m] + moved[m]);
    }
    write(speeds, result);
    report_loss(result);
  }

 private:
  bool moves() const {
    const auto moving = [&](Index b) { return is_moving(states_[b]); };
    return std::any_of(bodies_.begin(), bodies_.end(), moving) ||
           std::any_of(joints_.begin(), joints_.end(),
                       [&](Index j) { return scene_.joints[j].initial_velocity.value_or(0) != 0; });
  }

  std::optional<std::size_t> member_at(const std::optional<Index>& body) const {
    return body ? std::optional(member_of_.at(*body)) : std::nullopt;
  }

  void add_column(std::size_t member, const Screw& screw, std::optional<double> speed) {
    tree_.members.push_back(member);
    tree_.screws.push_back(screw);
    tree_.given.push_back(speed ? 1 : 0);
    given_speeds_.push_back(speed.value_or(0));
  }

  void add_columns(std::size_t member) {
    const ForestBody& link = forest_.bodies[bodies_[member]];
    if (!link.joint) {
      const bool free = !scene_.bodies[bodies_[member]].kinematic;
      for (int i = 0; free && i < 6; ++i) {
        const Vec3d axis = unit_axis(static_cast<Axis>(i % 3));
        add_column(member,
                   i < 3 ? Screw{{}, axis} : turn_about(places_.center_of(bodies_[member]), axis),
                   std::nullopt);
      }
      return;
    }
    const JointMotion motion = places_.motion_of(*link.joint);
    const double sign = link.reversed ? -1 : 1;
    first_column_[*link.joint] = tree_.members.size();
    std::optional<double> speed = scene_.joints[*link.joint].initial_velocity;
    if (dofs_[*link.joint].count() != 1) {
      speed.reset();
    }
    for (const Vec3d& axis : motion.slides) {
      add_column(member, Screw{{}, axis} * sign, speed);
    }
    for (const Vec3d& axis : motion.turns) {
      add_column(member, turn_about(motion.point, axis) * sign, speed);
    }
  }

  // What a body does when only what is prescribed moves (base), and alone (wanted).
  void add_motions(std::size_t member) {
    const Index body = bodies_[member];
    const std::size_t parent = tree_.parents[member];
    Screw prescribed;
    for (std::size_t c = tree_.members.size(); c > 0 && tree_.members[c - 1] == member; --c) {
      prescribed = prescribed + tree_.screws[c - 1] * given_speeds_[c - 1];
    }
    const BodyState& state = states_[body];
    Screw wanted{
        state.angular_velocity,
        velocity_at({-state.angular_velocity, state.linear_velocity}, places_.center_of(body))};
    const ForestBody& link = forest_.bodies[body];
    if (link.joint && link.parent && links_ == LinkVelocities::OfJoints &&
        scene_.joints[*link.joint].articulation) {
      wanted = wanted_[parent] + prescribed;
    }
    wanted_.push_back(wanted);
    if (scene_.bodies[body].kinematic) {
      base_.push_back(wanted);
      pulled_ = pulled_ || length(wanted.turn) + length(wanted.move) > 0;
    } else {
      base_.push_back(parent == MotionTree::kNone ? prescribed : base_[parent] + prescribed);
    }
  }

  void add_members() {
    for (std::size_t m = 0; m < bodies_.size(); ++m) {
      const ForestBody& link = forest_.bodies[bodies_[m]];
      tree_.parents.push_back(link.parent ? member_of_.at(*link.parent) : MotionTree::kNone);
      tree_.inertias.push_back(places_.inertia_of(bodies_[m]));
      add_columns(m);
      add_motions(m);
    }
  }

  // ---- rows

  // The speed that a unit impulse gives to a body alone.
  double response(const std::optional<std::size_t>& member, const Screw& impulse) const {
    if (!member || scene_.bodies[bodies_[*member]].kinematic) {
      return 0;
    }
    const Index body = bodies_[*member];
    const Vec3d twist = impulse.turn - cross(places_.center_of(body), impulse.move);
    return dot(impulse.move, impulse.move) / tree_.inertias[*member].mass +
           dot(twist, twist * inverse(places_.inertia_about_center(body)));
  }

  std::vector<LoopRow> rows_of(Index joint) const {
    const Joint& j = scene_.joints[joint];
    const JointMotion motion = places_.motion_of(joint);
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

  void add_rows() {
    for (const Index joint : joints_) {
      if (forest_.joints[joint] == ForestRole::Loop && holds(scene_.joints[joint])) {
        const std::vector<LoopRow> rows = rows_of(joint);
        loops_.rows.insert(loops_.rows.end(), rows.begin(), rows.end());
      }
      for (const Mimic& mimic : scene_.joints[joint].mimics) {
        add_mimic(joint, mimic);
      }
    }
  }

  std::optional<std::size_t> column_of(Index joint, Dof dof) const {
    const auto first = first_column_.find(joint);
    for (std::size_t i = 0; first != first_column_.end() && i < dofs_[joint].free.size(); ++i) {
      if (dofs_[joint].free[i].dof == dof) {
        return first->second + i;
      }
    }
    return std::nullopt;
  }

  // Soft mimics are springs, which give no impulse.
  void add_mimic(Index joint, const Mimic& mimic) {
    const auto follower = column_of(joint, mimic.dof);
    const auto leader = column_of(mimic.leader, mimic.leader_dof);
    const bool rigid = mimic.natural_frequency == 0 && mimic.parts.mujoco.solref.empty();
    if (!follower || !leader || !rigid) {
      return;
    }
    SpeedRow row{*follower, *leader, mimic.multiplier, 1};
    const double at = places_.coordinate(mimic.leader, mimic.leader_dof);
    for (std::size_t i = 0; i < mimic.higher.size(); ++i) {
      row.ratio +=
          static_cast<double>(i + 2) * mimic.higher[i] * std::pow(at, static_cast<double>(i + 1));
    }
    const std::size_t member = tree_.members[row.follower];
    const double inertia = dot(tree_.screws[row.follower],
                               tree_.inertias[member].momentum(tree_.screws[row.follower]));
    row.size = inertia > 0 ? std::sqrt(inertia) : 1;
    loops_.speed_rows.push_back(row);
  }

  // ---- the solution

  std::vector<double> nearest_speeds() {
    inertia_.emplace(tree_);
    std::vector<Screw> momenta;
    for (std::size_t m = 0; m < bodies_.size(); ++m) {
      momenta.push_back(tree_.inertias[m].momentum(wanted_[m] - base_[m]));
    }
    std::vector<double> speeds = tree_.along_columns(std::move(momenta));
    inertia_->solve(speeds);
    return speeds;
  }

  // ---- the result

  void write(const std::vector<double>& speeds, FittedVelocities& result) const {
    for (std::size_t m = 0; m < bodies_.size(); ++m) {
      const Index body = bodies_[m];
      if (!scene_.bodies[body].kinematic) {
        result.bodies[body].angular_velocity = motion_[m].turn;
        result.bodies[body].linear_velocity = velocity_at(motion_[m], places_.center_of(body));
      }
    }
    for (const auto& [joint, first] : first_column_) {
      for (std::size_t i = 0; i < dofs_[joint].count(); ++i) {
        result.joints[joint][i] = speeds[first + i] + given_speeds_[first + i];
      }
    }
    for (const Index joint : joints_) {
      if (forest_.joints[joint] == ForestRole::Loop && holds(scene_.joints[joint])) {
        result.joints[joint] = loop_speeds(joint);
      }
    }
  }

  std::vector<double> loop_speeds(Index joint) const {
    const Joint& j = scene_.joints[joint];
    const JointMotion motion = places_.motion_of(joint);
    Screw relative = j.body1 ? motion_[member_of_.at(*j.body1)] : Screw{};
    relative = relative - (j.body0 ? motion_[member_of_.at(*j.body0)] : Screw{});
    std::vector<double> result = shares_of(motion.slides, velocity_at(relative, motion.point));
    const std::vector<double> turns = shares_of(motion.turns, relative.turn);
    result.insert(result.end(), turns.begin(), turns.end());
    return result;
  }

  double energy_of(std::size_t member, const Screw& motion) const {
    return dot(motion, tree_.inertias[member].momentum(motion)) / 2;
  }

  void report_loss(FittedVelocities& result) const {
    LostEnergy loss;
    for (std::size_t m = 0; m < bodies_.size(); ++m) {
      loss.energy += energy_of(m, wanted_[m]);
      loss.lost += energy_of(m, motion_[m] - wanted_[m]);
    }
    if (pulled_ || !(loss.lost > kNoticedLoss * loss.energy)) {
      return;
    }
    double worst = 0;
    for (const Index joint : joints_) {
      if (forest_.joints[joint] == ForestRole::None || !holds(scene_.joints[joint])) {
        continue;
      }
      double violation = 0;
      double speed = 0;
      double turn = 0;
      for (const LoopRow& row : rows_of(joint)) {
        const double along = speed_along(row, wanted_);
        violation += along * along;
        const double plain = row.size > 0 ? along / row.size : 0;
        (row.impulse.move == Vec3d{} ? turn : speed) += plain * plain;
      }
      if (violation > worst) {
        worst = violation;
        loss.joint = joint;
        loss.speed = std::sqrt(speed);
        loss.turn_speed = std::sqrt(turn);
      }
    }
    if (worst > 0) {
      result.losses.push_back(loss);
    }
  }

  const PhysicsScene& scene_;
  const JointForest& forest_;
  const std::vector<JointDofs>& dofs_;
  const std::vector<BodyState>& states_;
  Places places_;
  LinkVelocities links_;
  std::vector<Index> bodies_;  // (member_count), parents before children
  std::vector<Index> joints_;
  std::map<Index, std::size_t> member_of_;
  std::map<Index, std::size_t> first_column_;  // of each joint of the tree
  MotionTree tree_;
  std::vector<double> given_speeds_;  // (column_count), 0 for those that are sought
  std::vector<Screw> wanted_;         // (member_count)
  std::vector<Screw> base_;           // (member_count)
  std::vector<Screw> motion_;         // (member_count)
  LoopRows loops_;
  std::optional<TreeInertia> inertia_;
  bool pulled_ = false;  // by kinematic bodies that move
};

bool is_pair(const Joint& joint) { return joint.body0 && joint.body1; }

/// Bodies connected by joints and mimics: for each body the representative of its group.
DisjointSets groups_of(const PhysicsScene& scene, const JointForest& forest) {
  DisjointSets groups(scene.bodies.size());
  const auto any_side = [&](Index j) {
    const Joint& joint = scene.joints[j];
    return joint.body0 ? joint.body0 : joint.body1;
  };
  for (Index j = 0; j < scene.joints.size(); ++j) {
    const Joint& joint = scene.joints[j];
    if (forest.joints[j] == ForestRole::None) {
      continue;
    }
    if (is_pair(joint)) {
      groups.join(*joint.body0, *joint.body1);
    }
    for (const Mimic& mimic : joint.mimics) {
      if (any_side(j) && any_side(mimic.leader)) {
        groups.join(*any_side(j), *any_side(mimic.leader));
      }
    }
  }
  return groups;
}

}  // namespace

FittedVelocities fit_velocities(const PhysicsScene& scene, const JointForest& forest,
                                const std::vector<JointDofs>& dofs,
                                const std::vector<BodyState>& states, LinkVelocities links) {
  FittedVelocities result;
  result.bodies = states;
  for (const JointDofs& joint : dofs) {
    result.joints.emplace_back(joint.count(), 0.0);
  }
  DisjointSets sets = groups_of(scene, forest);
  std::map<std::size_t, Group> groups;
  for (Index j = 0; j < scene.joints.size(); ++j) {
    const Joint& joint = scene.joints[j];
    if (forest.joints[j] != ForestRole::None && (joint.body0 || joint.body1)) {
      const std::size_t set = sets.find(joint.body0 ? *joint.body0 : *joint.body1);
      groups.try_emplace(set, scene, forest, dofs, states, links).first->second.add_joint(j);
    }
  }
  for (const Index body : forest.order) {
    const auto group = groups.find(sets.find(body));
    if (group != groups.end()) {
      group->second.add_body(body);
    }
  }
  for (auto& [set, group] : groups) {
    group.solve(result);
  }
  return result;
}

std::vector<BodyState> states_at_start(const PhysicsScene& scene, double time_step) {
  std::vector<BodyState> states;
  for (const Body& body : scene.bodies) {
    const bool still = body.kinematic || body.starts_asleep;
    states.push_back({body.pose, still ? Vec3d{} : body.linear_velocity,
                      still ? Vec3d{} : body.angular_velocity});
  }
  for (const PoseTrack& track : scene.pose_tracks) {
    if (!track.body || !scene.bodies[*track.body].kinematic || track.times.empty()) {
      continue;
    }
    const Pose first = track.at(0);
    const Pose next = track.at(time_step);
    BodyState& state = states[*track.body];
    const Vec3d& center = scene.bodies[*track.body].center_of_mass;
    state.linear_velocity =
        (transform_point(next, center) - transform_point(first, center)) * (1 / time_step);
    state.angular_velocity =
        rotation_vector(normalized(next.orientation) * conjugate(normalized(first.orientation))) *
        (1 / time_step);
  }
  return states;
}

bool anything_moves(const PhysicsScene& scene, const std::vector<BodyState>& states) {
  return std::any_of(states.begin(), states.end(), is_moving) ||
         std::any_of(scene.joints.begin(), scene.joints.end(),
                     [](const Joint& joint) { return joint.initial_velocity.value_or(0) != 0; });
}

std::string words_of(const LostEnergy& loss) {
  char text[256];
  std::snprintf(text, sizeof(text),
                "the velocities of the bodies part the joint's frames by %.3g m/s and %.3g "
                "degrees/s; the joint takes %.3g J of %.3g J at the start",
                loss.speed, loss.turn_speed * 180 / M_PI, loss.lost, loss.energy);
  return text;
}

}  // namespace tenon::scene
