// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/scene/joint_forest.h"
#include "tenon/scene/physics_scene.h"

/// Internal to tenon/dynamics.
namespace tenon::dynamics {

using scene::Index;

/// What is masked, by place.
struct MaskPlan {
  explicit MaskPlan(const scene::PhysicsScene& scene)
      : body_off(scene.bodies.size()),
        collider_off(scene.colliders.size(), 0),
        joint_off(scene.joints.size(), 0),
        joint_held(scene.joints.size(), 0),
        link_bypassed(scene.bodies.size(), 0),
        anchored(scene.bodies.size(), 0) {}

  /// The deactivated link that it hangs on, or itself; none: it stays. (body_count)
  std::vector<std::optional<Index>> body_off;
  std::vector<char> collider_off;   // of those that no body has (collider_count)
  std::vector<char> joint_off;      // deactivated (joint_count)
  std::vector<char> joint_held;     // bypassed (joint_count)
  std::vector<char> link_bypassed;  // each hangs on something (body_count)
  std::vector<char> anchored;       // (body_count)
};

/// Does it; `forest` is that of the scene, whose bodies stand where they start.
void mask_scene(const MaskPlan& plan, const scene::JointForest& forest, scene::PhysicsScene& scene,
                Diagnostics& findings);

/// What is masked while it is done: the links that a mask switches off, and those joints too.
struct Masked {
  std::vector<char> body_off;      // (body_count)
  std::vector<char> collider_off;  // of no body (collider_count)
  std::vector<char> joint_off;     // (joint_count)
  std::vector<char> joint_held;    // (joint_count)
  std::vector<char> anchored;      // (body_count)

  bool is_off(Index body) const { return body_off[body] != 0; }
  bool is_off(const std::optional<Index>& body) const { return body && is_off(*body); }
  /// It has no coordinate any more.
  bool is_masked(Index joint) const { return joint_off[joint] != 0 || joint_held[joint] != 0; }
};

/// Stops what refers to masked parts, and drops their tracks.
void drop_references(const Masked& masked, scene::PhysicsScene& scene, Diagnostics& findings);

/// Brings an articulation up to date with joints that do not act any more and bodies that are
/// switched off. A joint that closed a loop which is open now joins the tree, and links that
/// are joined to its root link no longer become articulations behind it, with the same path.
/// -> how many it is now.
std::size_t trim_articulation(Index articulation, scene::PhysicsScene& scene);

}  // namespace tenon::dynamics
