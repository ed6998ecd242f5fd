// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tenon/engines/jolt/convert.h"
#include "tenon/engines/jolt/run/tree_holder.h"
#include "tenon/engines/simulation_values.h"
#include "tenon/scene/joint_dofs.h"

namespace tenon::engines::jolt {

/// One coordinate of a joint between two bodies of Jolt, seen from their centres of mass.
struct CoordinateOf {
  JPH::Body* body0 = nullptr;
  JPH::Body* body1 = nullptr;
  Pose frame0;  ///< in the frame of the centre of mass of body0
  Pose frame1;
  const scene::JointDofs* dofs = nullptr;
  scene::Index joint = 0;
  std::size_t index = 0;   ///< as in JointState
  double coefficient = 1;  ///< what its speed counts in the sum
  double position = 0;     ///< at the beginning of the step, whole turns counted [m or rad]
  Wrench push;             ///< on body1 about the joint's point, of a unit along the sum
};

/// What acts along a coordinate.
enum class TermKind : std::uint8_t {
  Spring,    ///< stiffness (target - q) + damping (target velocity - v), at most max_force
  Force,     ///< the same of the beginning of the step alone
  Lower,     ///< q >= target_position
  Upper,     ///< q <= target_position
  Friction,  ///< at most max_force against the motion
  Armature,  ///< inertia of it alone
  Slowest,   ///< v >= target_velocity
  Fastest,   ///< v <= target_velocity
  Equal,     ///< q = target_position
};

struct LawTerm {
  TermKind kind = TermKind::Spring;
  double stiffness = 0;  ///< of bounds and equalities: 0 is hard
  double damping = 0;
  double max_force = scene::kUnlimited;
  double target_position = 0;
  double target_velocity = 0;
  bool acceleration = false;  ///< stiffness and damping are per unit of the moved inertia
  double restitution = 0;     ///< of bounds
  double bounce_threshold = 0;
  scene::DriveEnvelope envelope{};
  bool own = false;    ///< Spring: of the joint itself, no drive
  double inertia = 0;  ///< of Armature [kg m^2 or kg]

  // Of the step:
  bool acts = false;
  double softness = 0;
  double wanted = 0;  ///< speed
  double mass = 0;    ///< impulse by speed
  double least = 0;   ///< impulse
  double most = 0;
  double impulse = 0;
};

/// All that acts along one coordinate, or along a sum of coordinates, as a constraint of Jolt with
/// one row for each term: drives with the law that other engines have, springs, bounds beyond a
/// turn, friction, armature, mimics. Jolt's own motors know none of damping alone, of targets
/// beyond half a turn, and of more than one thing at once.
class CoordinateLaw final : public JPH::Constraint {
 public:
  explicit CoordinateLaw(std::vector<CoordinateOf> parts);

  std::vector<LawTerm> terms;
  double offset = 0;  ///< what is taken off the sum
  /// Of a mimic: coefficients of powers 2 to 4 of the second part's position.
  std::array<double, 3> powers{};

  /// Before each step: where the coordinate is, and what each term is to do.
  void prepare(double time_step);
  /// The sum as the bodies stand.
  double length_now() {
    count_turns();
    return value();
  }
  /// How the sum changes with the coordinate of a part.
  double slope(std::size_t part) const;
  /// The tree that has all joints of the sum; without one each joint is seen by itself.
  void set_tree(TreeHolder* tree) { tree_ = tree; }
  /// Tells its tree what all terms together have exerted during the last step.
  void note_impulse() const;
  /// The joint's own damper, friction or armature; null: it has none.
  LawTerm* own_term(Parameter what);
  double position() const { return parts_.front().position; }
  /// What all terms together exerted on body1 of a part about its joint's point during the last
  /// step, with what keeps the joint whole, as impulses [N s, N m s].
  Wrench impulse(std::size_t part) const;
  /// Speed of the sum [m/s or rad/s].
  double speed() const;
  /// Inertia that a force along the sum moves [kg m^2 or kg]; infinite where it moves nothing.
  double inertia() const;
  const std::vector<CoordinateOf>& parts() const { return parts_; }
  /// Counts turns from there: of joints that start beyond one.
  void count_from(std::size_t part, double position) { parts_[part].position = position; }

  // NOLINTBEGIN(readability-identifier-naming): names of Jolt
  JPH::EConstraintSubType GetSubType() const override { return JPH::EConstraintSubType::User1; }
  void NotifyShapeChanged(const JPH::BodyID& /*body*/, JPH::Vec3Arg /*moved*/) override {}
  void ResetWarmStart() override;
  bool IsActive() const override;
  void SetupVelocityConstraint(float /*time_step*/) override {}
  void WarmStartVelocityConstraint(float ratio) override;
  bool SolveVelocityConstraint(float time_step) override;
  bool SolvePositionConstraint(float time_step, float baumgarte) override;
  void BuildIslands(JPH::uint32 index, JPH::IslandBuilder& islands,
                    JPH::BodyManager& bodies) override;
  JPH::uint BuildIslandSplits(JPH::LargeIslandSplitter& islands) const override;
  void SaveState(JPH::StateRecorder& stream) const override;
  void RestoreState(JPH::StateRecorder& stream) override;
  JPH::Ref<JPH::ConstraintSettings> GetConstraintSettings() const override { return nullptr; }
  // NOLINTEND(readability-identifier-naming)

 private:
  /// What the speed of the sum is made of, of one body, and what an impulse along it does to it.
  struct Share {
    JPH::Body* body = nullptr;
    Vec3d linear;
    Vec3d angular;
    Vec3d linear_answer;
    Vec3d angular_answer;
  };
  /// A direction in which bodies move, body by body as in shares_, that a part's joint locks.
  struct Direction {
    std::size_t part = 0;
    Wrench push;  ///< of a unit on body1 about the joint's point
    std::vector<Vec3d> linear;
    std::vector<Vec3d> angular;
  };
  /// Its number, made if it is not one of the first `among`.
  std::size_t share_of(JPH::Body* body, std::size_t among = static_cast<std::size_t>(-1));
  void add_share(JPH::Body* body, const Vec3d& linear, const Vec3d& angular);
  void add_held(JPH::Body* body, const Vec3d& linear, const Vec3d& angular, Direction& held);
  void add_part(std::size_t index);
  /// Brings the positions of all parts up to date.
  void count_turns();
  void keep_joints_whole();
  void find_answers();
  void find_tree_answers();
  double total_impulse() const;
  double value() const;
  void prepare_term(LawTerm& term, double time_step, double speed);
  void prepare_bound(LawTerm& term, double time_step, double speed);
  void set_spring(LawTerm& term, double time_step) const;
  void push(double impulse) const;

  std::vector<CoordinateOf> parts_;
  std::vector<Share> shares_;
  std::vector<Direction> held_;  ///< what the parts' joints lock
  std::size_t speaking_ = 0;     ///< the first of the shares: those with a part in the speed
  TreeHolder* tree_ = nullptr;
  TreeHolder::Answer in_tree_;
  double answer_ = 0;    ///< speed by impulse
  double position_ = 0;  ///< of the sum
};

}  // namespace tenon::engines::jolt
