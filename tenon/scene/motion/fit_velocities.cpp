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
#include <utility>

#include "tenon/scene/motion/joint_motion.h"
#include "tenon/scene/motion/joint_tree.h"
#include "tenon/scene/motion/loop_impulses.h"
#include "tenon/scene/motion/tree_inertia.h"

namespace tenon::scene {
namespace {

constexpr double kLeastMass = 1e-9;      // [kg] of a body without mass
constexpr double kLeastMoment = 1e-13;   // [kg m^2]
constexpr double kNoticedLoss = 1e-4;    // of the energy
constexpr double kNoticedChange = 1e-3;  // of a velocity
constexpr double kNoSpeed = 1e-6;        // [m/s or rad/s]

bool is_moving(const BodyState& state) {
  return state.linear_velocity != Vec3d{} || state.angular_velocity != Vec3d{};
}

bool is_other(const Screw& a, const Screw& b) {
  const auto differ = [](const Vec3d& p, const Vec3d& q) {
    return length(p - q) > kNoticedChange * length(p) + kNoSpeed;
  };
  return differ(a.turn, b.turn) || differ(a.move, b.move);
}

class Group {
 public:
  Group(const PhysicsScene& scene, const JointForest& forest, const std::vector<JointDofs>& dofs,
        const std::vector<BodyState>& states, LinkVelocities links)
      : scene_(scene), forest_(forest), dofs_(dofs), states_(states), links_(links) {}

  bool moves(const JointGroup& group) const {
    const auto moving = [&](Index b) { return is_moving(states_[b]); };
    return std::any_of(group.bodies.begin(), group.bodies.end(), moving) ||
           std::any_of(group.joints.begin(), group.joints.end(),
                       [&](Index j) { return scene_.joints[j].initial_velocity.value_or(0) != 0; });
  }

  void solve(const JointGroup& group, const std::vector<Pose>& poses, FittedVelocities& result) {
    joints_.emplace(scene_, forest_, dofs_, poses, group,
                    JointTreeOptions{kLeastMass, kLeastMoment, TiedMimics::Rigid});
    give_speeds();
    for (std::size_t m = 0; m < joints_->bodies().size(); ++m) {
      add_motions(m);
    }
    std::vector<double> speeds = nearest_speeds();
    close_loops(joints_->tree(), *inertia_, joints_->loops(), base_, given_speeds_, speeds);
    const std::vector<Screw> moved = joints_->tree().motions(speeds);
    for (std::size_t m = 0; m < moved.size(); ++m) {
      motion_.push_back(base_[m] + moved[m]);
    }
    write(group, speeds, result);
    report_loss(group, result);
    result.unused.insert(result.unused.end(), unused_.begin(), unused_.end());
  }

 private:
  // Joints of one degree of freedom with an initial velocity have it.
  void give_speeds() {
    given_speeds_.assign(joints_->tree().members.size(), 0);
    for (const auto& [joint, column] : joints_->first_columns()) {
      const std::optional<double>& speed = scene_.joints[joint].initial_velocity;
      if (speed && dofs_[joint].count() == 1) {
        joints_->give(column);
        given_speeds_[column] = *speed;
      }
    }
  }

  // What a body does when only what is prescribed moves (base), and alone (wanted).
  void add_motions(std::size_t member) {
    const MotionTree& tree = joints_->tree();
    const Index body = joints_->bodies()[member];
    const std::size_t parent = tree.parents[member];
    Screw prescribed;
    for (; column_ < tree.members.size() && tree.members[column_] == member; ++column_) {
      prescribed = prescribed + tree.screws[column_] * given_speeds_[column_];
    }
    const BodyState& state = states_[body];
    Screw wanted{
        state.angular_velocity,
        velocity_at({-state.angular_velocity, state.linear_velocity}, joints_->center_of(body))};
    const ForestBody& link = forest_.bodies[body];
    if (link.joint && link.parent && links_ == LinkVelocities::OfJoints &&
        scene_.joints[*link.joint].articulation) {
      const Screw carried = wanted_[parent] + prescribed;
      if (is_moving(state) && is_other(wanted, carried)) {
        unused_.push_back(body);
      }
      wanted = carried;
    }
    wanted_.push_back(wanted);
    if (scene_.bodies[body].kinematic) {
      base_.push_back(wanted);
      pulled_ = pulled_ || length(wanted.turn) + length(wanted.move) > 0;
    } else {
      base_.push_back(parent == MotionTree::kNone ? prescribed : base_[parent] + prescribed);
    }
  }

  std::vector<double> nearest_speeds() {
    const MotionTree& tree = joints_->tree();
    inertia_.emplace(tree);
    std::vector<Screw> momenta;
    for (std::size_t m = 0; m < base_.size(); ++m) {
      momenta.push_back(tree.inertias[m].momentum(wanted_[m] - base_[m]));
    }
    std::vector<double> speeds = tree.along_columns(std::move(momenta));
    inertia_->solve(speeds);
    return speeds;
  }

  // ---- the result

  void write(const JointGroup& group, const std::vector<double>& speeds,
             FittedVelocities& result) const {
    for (std::size_t m = 0; m < motion_.size(); ++m) {
      const Index body = joints_->bodies()[m];
      if (!scene_.bodies[body].kinematic) {
        result.bodies[body].angular_velocity = motion_[m].turn;
        result.bodies[body].linear_velocity = velocity_at(motion_[m], joints_->center_of(body));
      }
    }
    for (const auto& [joint, first] : joints_->first_columns()) {
      for (std::size_t i = 0; i < dofs_[joint].count(); ++i) {
        result.joints[joint][i] = speeds[first + i] + given_speeds_[first + i];
      }
    }
    for (const Index joint : group.joints) {
      if (forest_.joints[joint] == ForestRole::Loop && holds(scene_.joints[joint])) {
        result.joints[joint] = loop_speeds(joint);
      }
    }
  }

  std::vector<double> loop_speeds(Index joint) const {
    const Joint& j = scene_.joints[joint];
    const JointMotion motion = joints_->motion_of(joint);
    Screw relative = j.body1 ? motion_[joints_->member_of(*j.body1)] : Screw{};
    relative = relative - (j.body0 ? motion_[joints_->member_of(*j.body0)] : Screw{});
    std::vector<double> result = shares_of(motion.slides, velocity_at(relative, motion.point));
    const std::vector<double> turns = shares_of(motion.turns, relative.turn);
    result.insert(result.end(), turns.begin(), turns.end());
    return result;
  }

  double energy_of(std::size_t member, const Screw& motion) const {
    return dot(motion, joints_->tree().inertias[member].momentum(motion)) / 2;
  }

  void report_loss(const JointGroup& group, FittedVelocities& result) const {
    LostEnergy loss;
    for (std::size_t m = 0; m < motion_.size(); ++m) {
      loss.energy += energy_of(m, wanted_[m]);
      loss.lost += energy_of(m, motion_[m] - wanted_[m]);
    }
    if (pulled_ || !(loss.lost > kNoticedLoss * loss.energy)) {
      return;
    }
    double worst = 0;
    for (const Index joint : group.joints) {
      if (!holds(scene_.joints[joint])) {
        continue;
      }
      double violation = 0;
      double speed = 0;
      double turn = 0;
      for (const LoopRow& row : joints_->rows_of(joint)) {
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
  LinkVelocities links_;
  std::optional<JointTree> joints_;
  std::vector<double> given_speeds_;  // (column_count), 0 for those that are sought
  std::size_t column_ = 0;            // the next one in add_motions
  std::vector<Screw> wanted_;         // (member_count)
  std::vector<Screw> base_;           // (member_count)
  std::vector<Screw> motion_;         // (member_count)
  std::vector<Index> unused_;
  std::optional<TreeInertia> inertia_;
  bool pulled_ = false;  // by kinematic bodies that move
};

}  // namespace

FittedVelocities fit_velocities(const PhysicsScene& scene, const JointForest& forest,
                                const std::vector<JointDofs>& dofs,
                                const std::vector<BodyState>& states, LinkVelocities links) {
  FittedVelocities result;
  result.bodies = states;
  for (const JointDofs& joint : dofs) {
    result.joints.emplace_back(joint.count(), 0.0);
  }
  std::vector<Pose> poses;
  for (const BodyState& state : states) {
    poses.push_back(state.pose);
  }
  for (const JointGroup& members : joint_groups(scene, forest)) {
    Group group(scene, forest, dofs, states, links);
    if (group.moves(members)) {
      group.solve(members, poses, result);
    }
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
