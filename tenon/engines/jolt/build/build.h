// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/engines/jolt/convert.h"
#include "tenon/engines/jolt/model.h"
#include "tenon/engines/scene_timeline.h"
#include "tenon/engines/simulation_values.h"
#include "tenon/scene/joint_forest.h"

/// Neutral scene -> Jolt, pass by pass. Internal to the adapter.
namespace tenon::engines::jolt {

/// Jolt's iterations of velocities and positions where bodies hang on joints, and its own
/// elsewhere.
inline constexpr JPH::uint kTreeVelocitySteps = 20;
inline constexpr JPH::uint kTreePositionSteps = 4;
inline constexpr JPH::uint kJointVelocitySteps = 100;
inline constexpr JPH::uint kJointPositionSteps = 10;
inline constexpr JPH::uint kMostSteps = 255;  ///< Jolt keeps them in a byte

struct Build {
  Build(const scene::PhysicsScene& the_scene, const SimulationOptions& the_options,
        Diagnostics& findings)
      : scene(the_scene), options(the_options), diagnostics(findings) {}

  const scene::PhysicsScene& scene;
  const SimulationOptions& options;
  Diagnostics& diagnostics;
  scene::JointForest forest;
  std::vector<BodyState> states;  ///< where bodies are placed, and how they move (body_count)
  std::vector<JPH::Ref<CoordinateLaw>> sums;  ///< laws of several joints
  Model model;

  JPH::uint velocity_steps(JPH::uint usual) const {
    const auto asked = static_cast<JPH::uint>(std::max(options.methods.iterations, 0));
    return std::min(asked > 0 ? asked : usual, kMostSteps);
  }
  void set_steps(JPH::Constraint& constraint, bool in_tree) const {
    constraint.SetNumVelocityStepsOverride(
        velocity_steps(in_tree ? kTreeVelocitySteps : kJointVelocitySteps));
    constraint.SetNumPositionStepsOverride(in_tree ? kTreePositionSteps : kJointPositionSteps);
  }
  void report(const Path& prim, const std::string& property, const std::string& why) {
    model.not_mapped.push_back({prim, property, why});
  }
};

/// Errors: Invalid where Jolt refuses the scene.
Result<Model> build_model(const scene::PhysicsScene& scene, const SimulationOptions& options,
                          double time_step, Diagnostics& diagnostics, Begin begin);

// The passes, in their order.

/// Which joints act, and where bodies stand and how they move at the beginning.
void plan(Build& build, Begin begin);
void add_systems(Build& build);
/// Bodies with their shapes, and static ones of colliders.
Result<void> add_bodies(Build& build, Begin begin);
/// Joints that are held together as trees.
void add_trees(Build& build);
/// What holds what the other joints lock.
void add_holders(Build& build);
/// What acts along coordinates.
void add_laws(Build& build);
void add_mimics(Build& build);
void add_tendons(Build& build);
void report_unmapped(Build& build);
/// Puts constraints into their systems.
void insert_constraints(Build& build);

// What passes share.

/// Mass and inertia of a body.
void set_mass(const scene::Body& body, JPH::Body& made);
/// Jolt's body on one side of a joint: the world's where it has none.
JPH::Body& side_body(const Model& model, const std::optional<scene::Index>& body);
/// The frame of one side of a joint in the frame of its body's centre of mass.
Pose side_frame(const scene::PhysicsScene& scene, const std::optional<scene::Index>& body,
                const Pose& frame);
/// The coordinate `index` of a joint for a law.
CoordinateOf coordinate_of(const Build& build, scene::Index joint, std::size_t index);
/// Which coordinate of a joint a degree of freedom is.
std::optional<std::size_t> coordinate_number(const JointMap& map, scene::Dof dof);
/// Numbers of a drive, as its term has them.
void write_drive(const scene::Drive& drive, LawTerm& term);

}  // namespace tenon::engines::jolt
