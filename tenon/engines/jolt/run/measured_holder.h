// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/engines/jolt/convert.h"
#include "tenon/engines/simulation_values.h"

namespace tenon::engines::jolt {

/// A constraint of Jolt that is asked what it has exerted during a step, whatever its kind: seen
/// from what it changes of the motion of one of its bodies.
class MeasuredHolder final : public JPH::Constraint {
 public:
  /// `point1`: where the joint is, from the centre of mass of body 1.
  MeasuredHolder(JPH::TwoBodyConstraint* holder, const Vec3d& point1);

  /// What it exerted on body 1 about the joint's point during the last step, as impulses [N s, N m
  /// s], world axes.
  Wrench impulse() const;

  // NOLINTBEGIN(readability-identifier-naming): names of Jolt
  JPH::EConstraintSubType GetSubType() const override { return JPH::EConstraintSubType::User2; }
  void NotifyShapeChanged(const JPH::BodyID& /*body*/, JPH::Vec3Arg /*moved*/) override {}
  void ResetWarmStart() override { holder_->ResetWarmStart(); }
  bool IsActive() const override { return GetEnabled() && holder_->IsActive(); }
  void SetupVelocityConstraint(float time_step) override;
  void WarmStartVelocityConstraint(float ratio) override;
  bool SolveVelocityConstraint(float time_step) override;
  bool SolvePositionConstraint(float time_step, float baumgarte) override {
    return holder_->SolvePositionConstraint(time_step, baumgarte);
  }
  void BuildIslands(JPH::uint32 index, JPH::IslandBuilder& islands,
                    JPH::BodyManager& bodies) override {
    holder_->BuildIslands(index, islands, bodies);
  }
  JPH::uint BuildIslandSplits(JPH::LargeIslandSplitter& islands) const override {
    return holder_->BuildIslandSplits(islands);
  }
  void SaveState(JPH::StateRecorder& stream) const override;
  void RestoreState(JPH::StateRecorder& stream) override;
  JPH::Ref<JPH::ConstraintSettings> GetConstraintSettings() const override { return nullptr; }
  // NOLINTEND(readability-identifier-naming)

 private:
  struct Motion {
    JPH::Vec3 linear;
    JPH::Vec3 angular;
  };
  Motion motion() const;
  void add(const Motion& before);

  JPH::Ref<JPH::TwoBodyConstraint> holder_;
  JPH::Body* body_;  ///< that is looked at: body 1, or body 0 where that cannot be moved
  double side_;      ///< 1 of body 1, -1 of body 0
  Vec3d point1_;
  Vec3d arm_;     ///< to the joint from the body's centre of mass, when the step began
  Vec3d linear_;  ///< change of speed since the step began
  Vec3d angular_;
  Quatd turned_ = kIdentityRotation;  ///< of the body when the step began
};

}  // namespace tenon::engines::jolt
