// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// With v = base + J q, where base is what roots that are moved take along, the least change of
// velocities v0 is M q = J^T P (v0 - base), where P are the bodies' inertias and M that of the tree
// (Gauss's principle, as in scene/motion/fit_velocities.cpp). Positions are brought back likewise:
// what the joints leave free stays, from the root outward; a tree that floats keeps its centre.
#include "tenon/engines/jolt/run/tree_holder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Jolt/Physics/Body/Body.h>
#include <Jolt/Physics/Body/BodyManager.h>
#include <Jolt/Physics/IslandBuilder.h>
#include <Jolt/Physics/LargeIslandSplitter.h>

#include "tenon/engines/scene_timeline.h"
#include "tenon/math/inertia.h"
#include "tenon/scene/motion/joint_motion.h"

namespace tenon::engines::jolt {
namespace {

using scene::MotionTree;
using scene::Screw;

constexpr double kPlaced = 1e-7;   ///< [m, rad] nearer bodies are not moved
constexpr double kSettled = 1e-6;  ///< [m/s, rad/s] smaller changes are none

class TreeSettings final : public JPH::ConstraintSettings {};

bool is_near(const Vec3d& a, const Vec3d& b, double bound) {
  return dot(a - b, a - b) < bound * bound;
}

}  // namespace

TreeHolder::TreeHolder(std::vector<TreeMember> members)
    : Constraint(TreeSettings()), members_(std::move(members)) {
  for (std::size_t m = 0; m < members_.size(); ++m) {
    if (members_[m].joint.has_value()) {
      member_of_[*members_[m].joint] = m;
    }
  }
}

Pose TreeHolder::mass_pose(std::size_t member) const {
  const JPH::Body& body = *members_[member].body;
  return {from_jolt(body.GetCenterOfMassPosition()), from_jolt(body.GetRotation())};
}

std::pair<Pose, Pose> TreeHolder::frames(std::size_t member) const {
  const TreeMember& link = members_[member];
  const Pose own = mass_pose(member);
  const Pose other = link.parent == MotionTree::kNone ? Pose{} : mass_pose(link.parent);
  return link.reversed ? std::pair(own * link.frame0, other * link.frame1)
                       : std::pair(other * link.frame0, own * link.frame1);
}

void TreeHolder::add_columns(std::size_t member) {
  const TreeMember& link = members_[member];
  first_.push_back(tree_.members.size());
  points_.push_back({});
  const auto add = [&](const Screw& screw) {
    tree_.members.push_back(member);
    tree_.screws.push_back(screw);
    tree_.given.push_back(0);
  };
  if (!link.joint.has_value()) {
    for (int i = 0; link.body->IsDynamic() && i < 6; ++i) {
      const Vec3d axis = scene::unit_axis(static_cast<scene::Axis>(i % 3));
      add(i < 3 ? Screw{{}, axis} : scene::turn_about(centers_[member], axis));
    }
    return;
  }
  auto [frame0, frame1] = frames(member);
  frame0.position -= origin_;
  frame1.position -= origin_;
  points_.back() = frame1.position;
  const scene::JointMotion motion = joint_motion(*link.dofs, frame0, frame1);
  const double sign = link.reversed ? -1 : 1;
  for (const Vec3d& axis : motion.slides) {
    add(Screw{{}, axis} * sign);
  }
  for (const Vec3d& axis : motion.turns) {
    add(scene::turn_about(motion.point, axis) * sign);
  }
}

void TreeHolder::prepare() {
  origin_ = mass_pose(0).position;
  tree_ = {};
  first_.clear();
  centers_.clear();
  points_.clear();
  base_.clear();
  placed_.clear();
  noted_.assign(members_.size(), {});
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const TreeMember& link = members_[m];
    const Pose pose = mass_pose(m);
    centers_.push_back(pose.position - origin_);
    scene::RigidInertia inertia;
    if (link.body->IsDynamic()) {
      Mat3d own = rotate_inertia(pose.orientation, link.inertia);
      for (std::size_t i = 0; i < 3; ++i) {
        own[i][i] += kMinMoment;
      }
      inertia.mass = link.mass;
      inertia.moment = centers_[m] * link.mass;
      inertia.inertia = shift_inertia(own, link.mass, centers_[m]);
    }
    tree_.parents.push_back(link.parent);
    tree_.inertias.push_back(inertia);
    if (link.parent != MotionTree::kNone) {
      base_.push_back(base_[link.parent]);
    } else {
      base_.push_back(link.body->IsDynamic() ? Screw{} : velocity(m));
    }
    add_columns(m);
  }
  inertia_ = std::make_unique<scene::TreeInertia>(tree_);
}

/// As a motion about the origin.
Screw TreeHolder::velocity(std::size_t member) const {
  const JPH::Body& body = *members_[member].body;
  const Vec3d turn = from_jolt(body.GetAngularVelocity());
  return {turn, from_jolt(body.GetLinearVelocity()) - cross(turn, centers_[member])};
}

Screw TreeHolder::momentum(std::size_t member, const Screw& velocity) const {
  return tree_.inertias[member].momentum(velocity);
}

void TreeHolder::write(std::size_t member, const Screw& velocity) {
  JPH::MotionProperties& motion = *members_[member].body->GetMotionProperties();
  motion.SetAngularVelocity(to_jolt(velocity.turn));
  motion.SetLinearVelocity(to_jolt(scene::velocity_at(velocity, centers_[member])));
}

TreeHolder::Answer TreeHolder::answer(std::span<const Along> sum) const {
  std::vector<double> along(tree_.members.size(), 0);
  for (const Along& part : sum) {
    along[first_[member_of_.at(part.joint)] + part.index] += part.slope;
  }
  std::vector<double> speeds = along;
  inertia_->solve(speeds);
  Answer answer;
  for (std::size_t i = 0; i < along.size(); ++i) {
    answer.speed += along[i] * speeds[i];
  }
  const std::vector<Screw> motions = tree_.motions(speeds);
  for (std::size_t m = 0; m < members_.size(); ++m) {
    if (members_[m].body->IsDynamic()) {
      answer.bodies.push_back(members_[m].body);
      answer.velocities.push_back({motions[m].turn, scene::velocity_at(motions[m], centers_[m])});
    }
  }
  return answer;
}

void TreeHolder::note(const Answer& answer, double impulse) {
  std::size_t i = 0;
  for (std::size_t m = 0; m < members_.size(); ++m) {
    if (members_[m].body->IsDynamic()) {
      const Screw& velocity = answer.velocities[i++];
      const Screw about{velocity.turn, velocity.move - cross(velocity.turn, centers_[m])};
      noted_[m] = noted_[m] + momentum(m, about) * impulse;
    }
  }
}

// What comes through a joint is what changes the momentum of all that hangs on it.
Wrench TreeHolder::impulse(scene::Index joint) const {
  if (noted_.empty()) {
    return {};  // before the first step
  }
  const std::size_t top = member_of_.at(joint);
  std::vector<char> hangs(members_.size(), 0);
  Screw sum;
  for (std::size_t m = top; m < members_.size(); ++m) {
    const std::size_t parent = members_[m].parent;
    hangs[m] = m == top || (parent != MotionTree::kNone && hangs[parent] != 0) ? 1 : 0;
    sum = hangs[m] != 0 ? sum + noted_[m] : sum;
  }
  const double side = members_[top].reversed ? -1 : 1;
  return {sum.move * side, (sum.turn - cross(points_[top], sum.move)) * side};
}

void TreeHolder::set_mass(scene::Index body, double mass, const Mat3d& inertia) {
  for (TreeMember& member : members_) {
    if (member.index == body) {
      member.mass = mass;
      member.inertia = inertia;
    }
  }
}

/// Where the joint and what it leaves free put a member.
Pose TreeHolder::placed(std::size_t member) const {
  const TreeMember& link = members_[member];
  const auto [frame0, frame1] = frames(member);
  const Pose relative =
      relative_pose_at(*link.dofs, coordinates_at(*link.dofs, inverse(frame0) * frame1));
  return link.reversed ? frame1 * inverse(relative) * inverse(link.frame0)
                       : frame0 * relative * inverse(link.frame1);
}

// Contacts have pushed single bodies since all stood as the joints say: the tree takes it up as it
// takes up impulses.
void TreeHolder::share_pushes() {
  if (placed_.empty()) {
    return;
  }
  std::vector<Screw> momenta;
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const Pose now = mass_pose(m);
    const Vec3d turn =
        rotation_vector(normalized(now.orientation * conjugate(placed_[m].orientation)));
    const Vec3d move = now.position - placed_[m].position;
    momenta.push_back(momentum(m, {turn, move - cross(turn, centers_[m])}));
  }
  std::vector<double> shares = tree_.along_columns(std::move(momenta));
  inertia_->solve(shares);
  const std::vector<Screw> motions = tree_.motions(shares);
  for (std::size_t m = 0; m < members_.size(); ++m) {
    if (members_[m].body->IsDynamic()) {
      const Pose wanted{placed_[m].position + scene::velocity_at(motions[m], centers_[m]),
                        rotation_about(normalized(motions[m].turn), length(motions[m].turn)) *
                            placed_[m].orientation};
      move_to(m, wanted);
    }
  }
}

bool TreeHolder::move_to(std::size_t member, const Pose& wanted) {
  const Pose before = mass_pose(member);
  const Vec3d turn =
      rotation_vector(normalized(wanted.orientation * conjugate(before.orientation)));
  if (is_near(wanted.position, before.position, kPlaced) && is_near(turn, {}, kPlaced)) {
    return false;
  }
  members_[member].body->AddPositionStep(to_jolt(wanted.position - before.position));
  members_[member].body->AddRotationStep(to_jolt(turn));
  return true;
}

// From the root outward; a tree that floats keeps its centre.
bool TreeHolder::place_members() {
  const bool floats = members_.front().body->IsDynamic() && !members_.front().joint.has_value();
  Vec3d shift;
  double mass = 0;
  bool moved = false;
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const TreeMember& link = members_[m];
    if (!link.body->IsDynamic()) {
      continue;
    }
    mass += link.mass;
    if (link.joint.has_value()) {
      const Vec3d before = mass_pose(m).position;
      moved = move_to(m, placed(m)) || moved;
      shift += (mass_pose(m).position - before) * link.mass;
    }
  }
  for (const TreeMember& link : members_) {
    if (moved && floats && link.body->IsDynamic()) {
      link.body->AddPositionStep(to_jolt(shift * (-1 / mass)));
    }
  }
  return moved;
}

// NOLINTBEGIN(readability-identifier-naming): names of Jolt
bool TreeHolder::IsActive() const {
  return GetEnabled() && std::any_of(members_.begin(), members_.end(), [](const TreeMember& m) {
           return m.body->IsDynamic() && m.body->IsActive();
         });
}

bool TreeHolder::SolveVelocityConstraint(float /*time_step*/) {
  std::vector<Screw> before;
  std::vector<Screw> momenta;
  for (std::size_t m = 0; m < members_.size(); ++m) {
    before.push_back(velocity(m));
    momenta.push_back(momentum(m, before[m] - base_[m]));
  }
  std::vector<double> speeds = tree_.along_columns(std::move(momenta));
  inertia_->solve(speeds);
  const std::vector<Screw> motions = tree_.motions(speeds);
  bool changed = false;
  for (std::size_t m = 0; m < members_.size(); ++m) {
    if (!members_[m].body->IsDynamic()) {
      continue;
    }
    const Screw after = base_[m] + motions[m];
    noted_[m] = noted_[m] + momentum(m, after - before[m]);
    changed = changed || !is_near(after.turn, before[m].turn, kSettled) ||
              !is_near(scene::velocity_at(after, centers_[m]),
                       scene::velocity_at(before[m], centers_[m]), kSettled);
    write(m, after);
  }
  return changed;
}

bool TreeHolder::SolvePositionConstraint(float /*time_step*/, float /*baumgarte*/) {
  share_pushes();
  const bool moved = place_members();
  placed_.clear();
  for (std::size_t m = 0; m < members_.size(); ++m) {
    placed_.push_back(mass_pose(m));
  }
  return moved;
}

void TreeHolder::BuildIslands(JPH::uint32 index, JPH::IslandBuilder& islands,
                              JPH::BodyManager& bodies) {
  JPH::uint32 first = JPH::Body::cInactiveIndex;
  for (const TreeMember& link : members_) {
    if (!link.body->IsDynamic()) {
      continue;
    }
    if (!link.body->IsActive()) {
      const JPH::BodyID id = link.body->GetID();
      bodies.ActivateBodies(&id, 1);
    }
    const JPH::uint32 at = link.body->GetIndexInActiveBodiesInternal();
    first = first == JPH::Body::cInactiveIndex ? at : first;
    islands.LinkBodies(first, at);
  }
  islands.LinkConstraint(index, first, first);
}

// Large islands are not split here: steps run on one thread.
JPH::uint TreeHolder::BuildIslandSplits(JPH::LargeIslandSplitter& /*islands*/) const {
  return JPH::LargeIslandSplitter::cNonParallelSplitIdx;
}
// NOLINTEND(readability-identifier-naming)

}  // namespace tenon::engines::jolt
