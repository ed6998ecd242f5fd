// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Positions go from the roots outward, joint by joint; what closes loops is in loop_closure.cpp.
#include "tenon/dynamics/multibody.h"

#include <algorithm>
#include <array>
#include <utility>

#include "tenon/dynamics/loop_closure.h"
#include "tenon/math/mimic_law.h"
#include "tenon/scene/start_coordinate.h"

namespace tenon::dynamics {
namespace {

using scene::ForestBody;
using scene::ForestRole;
using scene::Joint;
using scene::JointDofs;
using scene::JointGroup;

constexpr std::size_t kNoCoordinate = static_cast<std::size_t>(-1);

std::optional<std::size_t> part_of(const JointDofs& dofs, scene::Dof dof) {
  for (std::size_t i = 0; i < dofs.free.size(); ++i) {
    if (dofs.free[i].dof == dof) {
      return i;
    }
  }
  return std::nullopt;
}

}  // namespace

bool is_driven(const Joint& joint, scene::Dof dof) {
  return std::any_of(joint.drives.begin(), joint.drives.end(),
                     [&](const scene::Drive& drive) { return drive.dof == dof; });
}

const scene::Mimic* mimic_of(const Joint& joint, scene::Dof dof) {
  const auto found = std::find_if(joint.mimics.begin(), joint.mimics.end(),
                                  [&](const scene::Mimic& mimic) { return mimic.dof == dof; });
  return found == joint.mimics.end() ? nullptr : &*found;
}

Multibody::Multibody(const scene::PhysicsScene& scene)
    : scene_(&scene), forest_(joint_forest(scene)) {
  const std::vector<scene::FreeRotations> wanted = wanted_rotations(scene);
  for (Index j = 0; j < scene.joints.size(); ++j) {
    dofs_.push_back(joint_dofs(scene.joints[j], wanted[j]));
  }
  first_coordinate_.assign(scene.joints.size(), kNoCoordinate);
  for (const Index body : forest_.order) {
    add_coordinates(body);
  }
  find_groups();
  find_followers();
}

void Multibody::add_coordinates(Index body) {
  const ForestBody& link = forest_.bodies[body];
  if (!link.joint) {
    constexpr std::array kAll{scene::Dof::TransX, scene::Dof::TransY, scene::Dof::TransZ,
                              scene::Dof::RotX,   scene::Dof::RotY,   scene::Dof::RotZ};
    for (std::size_t i = 0; !scene_->bodies[body].kinematic && i < kAll.size(); ++i) {
      coordinates_.push_back({std::nullopt, body, kAll[i], i});
    }
    return;
  }
  const JointDofs& dofs = dofs_[*link.joint];
  first_coordinate_[*link.joint] = coordinates_.size();
  for (std::size_t i = 0; i < dofs.free.size(); ++i) {
    coordinates_.push_back({link.joint, body, dofs.free[i].dof, i});
  }
  for (std::size_t i = 0; dofs.ball && i < 3; ++i) {
    const auto dof = static_cast<scene::Dof>(static_cast<std::size_t>(scene::Dof::RotX) + i);
    coordinates_.push_back({link.joint, body, dof, dofs.free.size() + i});
  }
}

void Multibody::find_groups() {
  groups_ = joint_groups(*scene_, forest_);
  group_of_.assign(scene_->bodies.size(), kNoCoordinate);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    for (const Index body : groups_[g].bodies) {
      group_of_[body] = g;
    }
  }
  for (Index body = 0; body < scene_->bodies.size(); ++body) {
    if (group_of_[body] == kNoCoordinate) {
      group_of_[body] = groups_.size();
      groups_.push_back({{body}, {}});
    }
  }
}

// Mimics whose leaders follow something come after it; those in a circle come last, as they are.
void Multibody::find_followers() {
  std::vector<Follower> waiting;
  std::vector<std::size_t> not_placed(scene_->joints.size(), 0);
  for (Index j = 0; j < scene_->joints.size(); ++j) {
    for (const scene::Mimic& mimic : scene_->joints[j].mimics) {
      waiting.push_back({j, &mimic});
      ++not_placed[j];
    }
  }
  while (!waiting.empty()) {
    const auto ready =
        std::stable_partition(waiting.begin(), waiting.end(),
                              [&](const Follower& f) { return not_placed[f.mimic->leader] == 0; });
    if (ready == waiting.begin()) {
      followers_.insert(followers_.end(), waiting.begin(), waiting.end());
      return;
    }
    for (auto f = waiting.begin(); f != ready; ++f) {
      followers_.push_back(*f);
      --not_placed[f->joint];
    }
    waiting.erase(waiting.begin(), ready);
  }
}

std::optional<std::size_t> Multibody::coordinate_of(Index joint, scene::Dof dof) const {
  const std::optional<std::size_t> part = part_of(dofs_[joint], dof);
  if (!part || first_coordinate_[joint] == kNoCoordinate) {
    return std::nullopt;
  }
  return first_coordinate_[joint] + *part;
}

void Multibody::follow(Posture& posture) const {
  for (const Follower& follower : followers_) {
    const scene::Mimic& mimic = *follower.mimic;
    const auto own = part_of(dofs_[follower.joint], mimic.dof);
    const auto leader = part_of(dofs_[mimic.leader], mimic.leader_dof);
    if (own && leader) {
      posture.joints[follower.joint][*own] =
          mimic_position(mimic, posture.joints[mimic.leader][*leader]);
    }
  }
}

void Multibody::place_bodies(Posture& posture) const {
  for (const Index body : forest_.order) {
    const ForestBody& link = forest_.bodies[body];
    if (!link.joint) {
      continue;
    }
    const Joint& joint = scene_->joints[*link.joint];
    const Pose relative = relative_pose_at(dofs_[*link.joint], posture.joints[*link.joint]);
    const Pose parent = link.parent ? posture.bodies[*link.parent] : Pose{};
    posture.bodies[body] = link.reversed
                               ? parent * joint.frame1 * inverse(relative) * inverse(joint.frame0)
                               : parent * joint.frame0 * relative * inverse(joint.frame1);
    posture.bodies[body].orientation = normalized(posture.bodies[body].orientation);
  }
}

Posture Multibody::start() const {
  Posture posture;
  for (const scene::Body& body : scene_->bodies) {
    posture.bodies.push_back(body.pose);
  }
  for (Index j = 0; j < scene_->joints.size(); ++j) {
    const Joint& joint = scene_->joints[j];
    posture.joints.push_back(coordinates_at(dofs_[j], relative_frames(*scene_, joint)));
    if (joint.initial_position && dofs_[j].count() == 1) {
      posture.joints[j][0] = *joint.initial_position;
    }
  }
  place_bodies(posture);
  return posture;
}

Posture Multibody::moved(const Posture& from, std::vector<std::vector<double>> joints) const {
  Posture posture{std::move(joints), from.bodies};
  follow(posture);
  place_bodies(posture);
  for (const JointGroup& group : groups_) {
    const auto closes = [&](Index j) {
      return forest_.joints[j] == ForestRole::Loop && scene::holds(scene_->joints[j]);
    };
    if (!std::any_of(group.joints.begin(), group.joints.end(), closes)) {
      continue;
    }
    constexpr int kSteps = 40;
    for (int i = 0; i < kSteps && loop_step(*this, group, posture); ++i) {
      follow(posture);
      place_bodies(posture);
    }
  }
  return posture;
}

double Multibody::loop_gap(const Posture& posture) const {
  double worst = 0;
  for (const Index j : forest_.loop_joints) {
    const Joint& joint = scene_->joints[j];
    if (scene::holds(joint)) {
      worst = std::max(worst, length(frames_apart(*this, posture, j).move));
    }
  }
  return worst;
}

}  // namespace tenon::dynamics
