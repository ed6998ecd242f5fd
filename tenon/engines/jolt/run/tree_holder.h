// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "tenon/engines/jolt/convert.h"
#include "tenon/engines/simulation_values.h"
#include "tenon/scene/joint_dofs.h"
#include "tenon/scene/motion/tree_inertia.h"

namespace tenon::engines::jolt {

/// One body of a tree, and the joint that it hangs on.
struct TreeMember {
  JPH::Body* body = nullptr;
  scene::Index index = 0;  ///< of the body in the scene
  std::size_t parent = scene::MotionTree::kNone;
  std::optional<scene::Index> joint;  ///< none: a root that nothing holds, or that is moved
  bool reversed = false;              ///< the body is body0 of the joint
  Pose frame0;                        ///< of the joint, from the centre of mass of body0
  Pose frame1;
  const scene::JointDofs* dofs = nullptr;
  double mass = 0;
  Mat3d inertia;  ///< about the centre of mass, body axes
};

/// The share of one coordinate in a sum.
struct Along {
  scene::Index joint = 0;
  std::size_t index = 0;  ///< as in JointState
  double slope = 1;
};

/// Holds all joints of a tree of bodies at once: of all velocities that they allow it gives the
/// bodies those that differ least from what they have, in kinetic energy, which is what the
/// impulses of the joints do together. Constraint by constraint Jolt needs hundreds of iterations
/// for the same where light links carry heavy ones, and links without mass it cannot hold.
class TreeHolder final : public JPH::Constraint {
 public:
  explicit TreeHolder(std::vector<TreeMember> members);

  scene::Index first_joint() const { return member_of_.begin()->first; }
  /// Before each step, before the laws of its joints.
  void prepare();
  /// What an impulse along a sum of coordinates does to the bodies.
  struct Answer {
    double speed = 0;                      ///< along the sum
    std::vector<JPH::Body*> bodies;        ///< (count)
    std::vector<scene::Screw> velocities;  ///< (count), `move` of the centre of mass
  };
  Answer answer(std::span<const Along> sum) const;
  /// Notes what a law has changed of the velocities.
  void note(const Answer& answer, double impulse);
  /// What body 0 exerted on body 1 through a joint during the last step about the origin of frame
  /// 1, as impulses.
  Wrench impulse(scene::Index joint) const;
  /// Changes the mass and inertia of a body.
  void set_mass(scene::Index body, double mass, const Mat3d& inertia);

  // NOLINTBEGIN(readability-identifier-naming): names of Jolt
  JPH::EConstraintSubType GetSubType() const override { return JPH::EConstraintSubType::User3; }
  void NotifyShapeChanged(const JPH::BodyID& /*body*/, JPH::Vec3Arg /*moved*/) override {}
  void ResetWarmStart() override {}
  bool IsActive() const override;
  void SetupVelocityConstraint(float /*time_step*/) override {}
  void WarmStartVelocityConstraint(float /*ratio*/) override {}
  bool SolveVelocityConstraint(float time_step) override;
  bool SolvePositionConstraint(float time_step, float baumgarte) override;
  void BuildIslands(JPH::uint32 index, JPH::IslandBuilder& islands,
                    JPH::BodyManager& bodies) override;
  JPH::uint BuildIslandSplits(JPH::LargeIslandSplitter& islands) const override;
  JPH::Ref<JPH::ConstraintSettings> GetConstraintSettings() const override { return nullptr; }
  // NOLINTEND(readability-identifier-naming)

 private:
  Pose mass_pose(std::size_t member) const;
  /// Where a member's frames are; the world's is where it is.
  std::pair<Pose, Pose> frames(std::size_t member) const;
  void add_columns(std::size_t member);
  scene::Screw velocity(std::size_t member) const;
  scene::Screw momentum(std::size_t member, const scene::Screw& velocity) const;
  void write(std::size_t member, const scene::Screw& velocity);
  Pose placed(std::size_t member) const;
  void share_pushes();
  bool move_to(std::size_t member, const Pose& wanted);
  bool place_members();

  std::vector<TreeMember> members_;
  std::map<scene::Index, std::size_t> member_of_;  ///< by joint
  // Of the step:
  Vec3d origin_;
  std::vector<Vec3d> centers_;  ///< (member_count) from the origin
  std::vector<Vec3d> points_;   ///< (member_count) origins of frames 1
  scene::MotionTree tree_;
  std::vector<std::size_t> first_;  ///< (member_count) column
  std::vector<scene::Screw> base_;  ///< (member_count) what roots that are moved take along
  std::unique_ptr<scene::TreeInertia> inertia_;
  std::vector<Pose> placed_;         ///< (member_count) of centres of mass, as joints allow
  std::vector<scene::Screw> noted_;  ///< (member_count) momenta that came through joints
};

}  // namespace tenon::engines::jolt
