// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tenon/physics/read_state.h"

namespace tenon::physics {

/// Gravity of a PhysicsScene prim at the time of `state` [m/s^2], world axes (S-14..S-17).
Vec3d scene_gravity(const ReadState& state, const PhysicsPrim& found);
std::optional<Index> scene_at(const ReadState& state, Path path);
/// The first scene in traversal order (S-18).
Index default_scene(const ReadState& state);

/// The scene that simulates a prim; not `found` when its owner is no scene (S-19).
struct OwnerScene {
  Index scene = 0;
  bool found = true;
};
OwnerScene owner_scene(const ReadState& state, const stage::Prim& prim, Index fallback);

}  // namespace tenon::physics
