// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "tenon/engines/jolt/jolt_headers.h"
#include "tenon/engines/jolt/run/coordinate_law.h"
#include "tenon/engines/jolt/run/measured_holder.h"
#include "tenon/engines/jolt/run/pair_listener.h"
#include "tenon/engines/jolt/run/tree_holder.h"
#include "tenon/engines/simulation_values.h"
#include "tenon/scene/joint_dofs.h"
#include "tenon/scene/joint_forest.h"
#include "tenon/scene/physics_scene.h"

/// A scene as Jolt has it, and what connects Jolt's objects with those of the neutral scene.
namespace tenon::engines::jolt {

/// Where a drive of a joint stands among its laws.
struct DriveAt {
  std::size_t law = 0;   ///< into JointMap::laws
  std::size_t term = 0;  ///< into CoordinateLaw::terms
};

struct JointMap {
  scene::JointDofs dofs;
  TreeHolder* tree = nullptr;  ///< that holds it; null: `holder` does
  bool acts = false;           ///< enabled, and between two different sides
  /// Holds what the joint locks; null: nothing.
  JPH::Ref<JPH::TwoBodyConstraint> holder;
  JPH::Ref<MeasuredHolder> measured;  ///< the same where its load is asked for; else null
  /// What acts along its coordinates, in the order of JointState; null: nothing (coordinate_count).
  std::vector<JPH::Ref<CoordinateLaw>> laws;
  std::vector<std::optional<DriveAt>> drives;  ///< (drive_count); none: it exerts nothing
};

/// One scene of the asset: they share nothing.
struct System {
  std::unique_ptr<PairListener> listener;  ///< outlives the system, which holds it
  std::unique_ptr<JPH::PhysicsSystem> system;
};

struct Model {
  Model() = default;
  Model(Model&&) noexcept = default;
  Model& operator=(Model&& other) noexcept;
  ~Model() { release(); }

  std::vector<System> systems;                ///< (scene_count)
  std::vector<JPH::Body*> bodies;             ///< (body_count)
  std::vector<JPH::Body*> static_bodies;      ///< (collider_count), null: of a body
  std::vector<JointMap> joints;               ///< (joint_count)
  std::vector<JPH::Ref<CoordinateLaw>> laws;  ///< all: of joints and of mimics
  std::vector<JPH::Ref<TreeHolder>> trees;
  scene::JointForest forest;
  std::vector<NotMapped> not_mapped;
  double time_step = 0;  ///< [s]

 private:
  void release();
};

Pose pose_of(const JPH::Body& body);

}  // namespace tenon::engines::jolt
