// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/live/move_joint.h"

#include <optional>
#include <utility>

#include "tenon/math/mimic_law.h"

namespace tenon::live {
namespace {

std::optional<std::size_t> coordinate_of_dof(const scene::JointDofs& dofs, scene::Dof dof) {
  for (std::size_t i = 0; i < dofs.free.size(); ++i) {
    if (dofs.free[i].dof == dof) {
      return i;
    }
  }
  return std::nullopt;
}

Result<void> place_at_rest(engines::World& world, scene::Index joint,
                           std::vector<double> position) {
  engines::JointState state;
  state.velocity.assign(position.size(), 0);
  state.position = std::move(position);
  return world.set_joint_state(joint, state);
}

/// Moves what follows `leader` with this joint; true where it does.
bool follow(LiveAsset& asset, scene::Index joint, scene::Index leader) {
  std::vector<double> position = asset.world->joint_state(joint).position;
  bool follows = false;
  for (const scene::Mimic& mimic : asset.scene().joints[joint].mimics) {
    const auto own = coordinate_of_dof(asset.dofs[joint], mimic.dof);
    const auto other = coordinate_of_dof(asset.dofs[mimic.leader], mimic.leader_dof);
    const std::vector<double> led = asset.world->joint_state(mimic.leader).position;
    if (mimic.leader == leader && own && other && *own < position.size() && *other < led.size()) {
      position[*own] = mimic_position(mimic, led[*other]);
      follows = true;
    }
  }
  return follows && place_at_rest(*asset.world, joint, std::move(position)).has_value();
}

}  // namespace

Result<void> move_joint(LiveAsset& asset, scene::Index joint, const std::vector<double>& position) {
  TENON_CHECK(place_at_rest(*asset.world, joint, position));
  const std::vector<scene::Joint>& joints = asset.scene().joints;
  std::vector<bool> moved(joints.size());  // a ring of followers ends where it began
  moved[joint] = true;
  std::vector<scene::Index> leaders = {joint};
  for (std::size_t i = 0; i < leaders.size(); ++i) {
    for (scene::Index follower = 0; follower < joints.size(); ++follower) {
      if (!moved[follower] && follow(asset, follower, leaders[i])) {
        moved[follower] = true;
        leaders.push_back(follower);
      }
    }
  }
  return {};
}

}  // namespace tenon::live
