// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/engines/physx/convert.h"
#include "tenon/engines/physx/model.h"
#include "tenon/engines/scene_timeline.h"
#include "tenon/engines/simulation_values.h"
#include "tenon/scene/joint_forest.h"

/// Neutral scene -> PhysX, pass by pass. Internal to the adapter.
namespace tenon::engines::physx {

/// PhysX's own numbers where the asset says none.
inline constexpr float kNoBound = 1e16F;  ///< of speeds, whose squares PhysX forms

struct Build {
  Build(const scene::PhysicsScene& the_scene, const Runtime& the_runtime,
        const SimulationOptions& the_options, Diagnostics& findings)
      : scene(the_scene), runtime(the_runtime), options(the_options), diagnostics(findings) {}

  const scene::PhysicsScene& scene;
  const Runtime& runtime;
  const SimulationOptions& options;
  Diagnostics& diagnostics;
  scene::JointForest forest;
  std::vector<px::PxMaterial*> materials;  ///< (material_count + 1), the last for the unbound
  Model model;

  void report(const Path& prim, const std::string& property, const std::string& why) {
    model.not_mapped.push_back({prim, property, why});
  }
};

/// Errors: Invalid with PhysX's words.
Result<Model> build_model(const scene::PhysicsScene& scene, const SimulationOptions& options,
                          double time_step, Diagnostics& diagnostics, Begin begin);

// The passes, in their order.

/// What each joint becomes, and which bodies are links of which tree.
void plan_joints(Build& build);
Result<void> add_scenes(Build& build);
void add_materials(Build& build);
/// Free bodies and links, without shapes.
Result<void> add_bodies(Build& build);
/// Shapes of bodies, and static actors.
void add_colliders(Build& build);
/// Coordinates, bounds and drives of joints of trees.
void set_reduced_joints(Build& build);
/// Constraints for the other joints.
void add_constraints(Build& build);
void add_mimics(Build& build);
void add_tendons(Build& build);
void report_unmapped(Build& build);
/// Puts everything into its scene, with the velocities and coordinates that it starts with.
void start(Build& build, Begin begin);

// What passes share.

/// Mass, centre of mass, inertia, damping and speeds of a body.
void set_mass(const scene::Body& body, px::PxRigidBody& made);
/// Other bounds of a joint of one axis, or of a distance, in a model that steps; false: only a new
/// model can have them, because something gets locked or free with them.
bool write_bounds(const scene::Joint& joint, JointMap& map);
px::PxArticulationLimit limits_of_coordinate(const scene::FreeDof& free);
/// Another coefficient of friction, static and dynamic, for the surface of a collider; false: it
/// has no shape.
bool set_friction(const scene::PhysicsScene& scene, scene::Index collider, double coefficient,
                  Model& model);

}  // namespace tenon::engines::physx
