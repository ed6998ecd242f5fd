// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A stage becomes a PhysicsScene in several passes. Each visits the prims that one walk found,
// reads one concept, converts its units to SI, and reports what it cannot take over. The S-numbers
// in the comments of the passes name the rules of docs/physics.md.
#include "tenon/physics/read_physics.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_set>

#include "tenon/approximate/mesh_approximator.h"
#include "tenon/physics/bodies/bodies_with_mass.h"
#include "tenon/physics/contents/read_approximated.h"
#include "tenon/physics/contents/read_outline.h"
#include "tenon/physics/joints/joint_checks.h"
#include "tenon/physics/read_state.h"
#include "tenon/scene/canonical_scene.h"

namespace tenon::physics {
namespace {

/// S-71
Material unbound_material(UnboundFriction reading) {
  constexpr double kFriction[] = {0.5, 1, 0};
  Material material;
  material.static_friction = kFriction[static_cast<std::size_t>(reading)];
  material.dynamic_friction = material.static_friction;
  return material;
}

ReadState begin(const stage::Stage& stage, const ReadOptions& options, Diagnostics& diagnostics) {
  Units units = read_units(stage, diagnostics);
  if (options.readings.time == TimeUnit::Stage) {
    units.rate = stage.time_codes_per_second();  // S-10
  }
  const double start =
      std::isnan(options.start_time_code) ? stage.start_time_code() : options.start_time_code;
  const AttributeValues values(stage::Time(start), layer_contents(stage),
                               options.readings.value_types, diagnostics);
  ReadState state{stage, diagnostics, physics_tokens(), options.readings, units, values};
  state.scene.meters_per_unit = units.length;
  state.scene.kilograms_per_unit = units.mass;
  state.scene.up = units.up;
  state.scene.start_time_code = start;
  state.scene.time_codes_per_second = stage.time_codes_per_second();
  state.scene.end_time_code = std::max(start, stage.end_time_code());
  state.scene.unbound = unbound_material(options.readings.unbound_friction);
  return state;
}

/// Findings on a prototype are reported once, not for each of its instances.
void append_once(const Diagnostics& found, Diagnostics& diagnostics) {
  std::unordered_set<std::string> said;
  for (const Diagnostic& finding : found) {
    if (said.insert(finding.prim + '\n' + finding.property + '\n' + finding.rule + '\n' +
                    finding.message)
            .second) {
      diagnostics.add(finding);
    }
  }
}

PhysicsScene read_walked(ReadState& state) {
  read_objects(state);
  read_tracks(state);
  let_fixed_roots_stay(state);
  read_moving_shapes(state);
  read_nesting(state);
  read_object_tracks(state);
  read_sensors(state);
  note_frozen_samples(state);
  note_what_is_not_read(state);
  return std::move(state.scene);
}

PhysicsScene read_stage(const stage::Stage& stage, const ReadOptions& options,
                        StaticMeshes static_meshes, Diagnostics& diagnostics,
                        Provenance* provenance, const AskedApproximation* asked = nullptr) {
  Diagnostics found;
  ReadState state = begin(stage, options, found);
  state.provenance = provenance;
  state.static_meshes = static_meshes;
  state.asked = asked;
  const MeshTools own = options.mesh_tools ? MeshTools() : approximate::mesh_tools({});
  state.mesh_tools = options.mesh_tools ? &*options.mesh_tools : &own;
  state.mesh_cache = options.mesh_cache;
  state.integrals = options.integrals ? &options.integrals : nullptr;
  state.walk = walk_stage(stage, state.values, options.readings);
  PhysicsScene scene = read_walked(state);
  make_canonical(scene);
  if (state.walk.instances.empty()) {
    diagnostics.append(found);
  } else {
    append_once(found, diagnostics);
  }
  return scene;
}

}  // namespace

void read_objects(ReadState& state) {
  read_bodies_with_mass(state);
  read_body_settings(state);
  read_joints(state);
  read_drives(state);
  read_actuators(state);
  read_tendons(state);
  read_physx_tendons(state);
  read_mujoco_actuators(state);
  read_joint_settings(state);
  read_limit_springs(state);
  read_mimics(state);
  read_gears(state);
  read_articulations(state);
  read_collision_groups(state);
  read_filtered_pairs(state);
}

void read_bodies_with_mass(ReadState& state) {
  read_scenes(state);
  read_bodies(state);
  read_materials(state);
  read_colliders(state);
  bind_materials(state);
  read_masses(state);
}

PhysicsScene read_physics(const stage::Stage& stage, const ReadOptions& options,
                          Diagnostics& diagnostics, Provenance* provenance) {
  return read_stage(stage, options, StaticMeshes::Read, diagnostics, provenance);
}

PhysicsScene read_outline(const stage::Stage& stage, const ReadOptions& options,
                          Diagnostics& diagnostics) {
  return read_stage(stage, options, StaticMeshes::Skipped, diagnostics, nullptr);
}

PhysicsScene read_approximated(const stage::Stage& stage, const ReadOptions& options,
                               const AskedApproximation& asked, Diagnostics& diagnostics) {
  return read_stage(stage, options, StaticMeshes::Read, diagnostics, nullptr, &asked);
}

}  // namespace tenon::physics
