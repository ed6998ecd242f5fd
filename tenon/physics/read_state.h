// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "tenon/base/function.h"
#include "tenon/physics/attribute_values.h"
#include "tenon/physics/colliders/mesh_cache.h"
#include "tenon/physics/colliders/shared_meshes.h"
#include "tenon/physics/contents/read_approximated.h"
#include "tenon/physics/physics_tokens.h"
#include "tenon/physics/provenance.h"
#include "tenon/physics/readings.h"
#include "tenon/physics/scene_names.h"
#include "tenon/physics/stage_walk.h"
#include "tenon/physics/units.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/scene/shapes/mesh_inertia.h"
#include "tenon/scene/shapes/mesh_tools.h"
#include "tenon/stage/stage.h"
#include "tenon/stage/targets/target_memo.h"

namespace tenon::physics {

/// Where a drive of a joint was read from.
struct DriveInstance {
  Index joint = 0;
  Index drive = 0;
  Token instance;
};

/// Whether the arrays of meshes that collide and stand still are read (contents/read_outline.h).
enum class StaticMeshes : std::uint8_t { Read, Skipped };

/// What the passes of read_physics share: the stage, what was found on it, and the description that
/// grows pass by pass. Lives for one reading.
struct ReadState {
  const stage::Stage& stage;
  Diagnostics& diagnostics;
  const PhysicsTokens& tokens;
  const Readings& readings;
  Units units;
  AttributeValues values;
  const MeshTools* mesh_tools = nullptr;
  const Function<std::optional<SolidIntegrals>(const stage::Prim&)>* integrals = nullptr;
  Provenance* provenance = nullptr;  ///< filled where not null
  MeshCache* mesh_cache = nullptr;
  StaticMeshes static_meshes = StaticMeshes::Read;
  const AskedApproximation* asked = nullptr;  ///< in the place of what meshes ask for
  SharedMeshes shared_meshes{};
  mutable stage::TargetMemo target_memo{};
  Walk walk{};
  PhysicsScene scene{};

  /// Prim of each body, collider, joint of `scene`, into walk.prims; (body_count) and so on.
  std::vector<std::uint32_t> body_prims{};
  std::vector<std::uint32_t> collider_prims{};
  std::vector<std::uint32_t> joint_prims{};
  /// Object of a prim, or kNone; (walk.prims.size()).
  std::vector<std::uint32_t> body_of_prim{};
  std::vector<std::uint32_t> collider_of_prim{};
  std::vector<std::uint32_t> joint_of_prim{};
  /// Colliders of each body, ascending; (body_count).
  std::vector<std::vector<Index>> colliders_of_body{};
  /// The transform of each body's prim is made of finite numbers; (body_count).
  std::vector<bool> body_has_place{};
  /// Integrals of colliders whose shape approximates a rounder solid.
  std::unordered_map<Index, SolidIntegrals> integrals_of_collider{};
  /// Drives of the drive API, in the order of joints.
  std::vector<DriveInstance> drive_instances{};
  /// Attributes that vary and give colliders their shapes, as "PRIM.attribute".
  std::unordered_set<std::string> sizes{};
  /// Attributes whose samples the description follows, or of which it is said that it does not.
  std::unordered_set<std::string> followed{};
  /// Materials of the scene by prim path.
  std::unordered_map<Path, Index> material_of_path{};

  /// The same stage, units and readings at another stage time, with nothing read yet.
  ReadState at(double code, Diagnostics& findings) const {
    return ReadState{stage,    findings, tokens,
                     readings, units,    values.at_sample(stage::Time(code), findings)};
  }
  /// [s] from the start of the simulation to a stage time.
  double seconds(double code) const {
    return (code - scene.start_time_code) / scene.time_codes_per_second;
  }

  /// What a relationship targets, as the prim sees it.
  std::vector<Path> targets(const stage::Prim& prim, Token name) const {
    return target_memo.targets(prim.relationship(name));
  }
  /// The object of the prim at a path, or kNone.
  std::uint32_t body_at(Path path) const { return object_at(path, body_of_prim); }
  std::uint32_t collider_at(Path path) const { return object_at(path, collider_of_prim); }
  std::uint32_t joint_at(Path path) const { return object_at(path, joint_of_prim); }

  const PhysicsPrim& prim_of_body(Index body) const { return walk.prims[body_prims[body]]; }
  const PhysicsPrim& prim_of_collider(Index i) const { return walk.prims[collider_prims[i]]; }
  const PhysicsPrim& prim_of_joint(Index i) const { return walk.prims[joint_prims[i]]; }
  bool has_place(Index body) const { return body_has_place[body]; }
  /// Its samples have a place in the description.
  void follow(const stage::Prim& prim, Token name) {
    followed.insert(prim.path().str() + "." + name.str());
  }
  bool follows(const stage::Prim& prim, Token name) const {
    return followed.contains(prim.path().str() + "." + name.str());
  }
  bool is_dynamic(Index body) const { return !scene.bodies[body].kinematic; }

  void report(const stage::Prim& prim, Severity severity, const char* rule, const Message& message,
              std::string fix, StatementPart part = {}) const {
    physics::report(diagnostics, prim, severity, rule, message, std::move(fix), std::move(part));
  }
  void report(const stage::Prim& prim, Token property, Severity severity, const char* rule,
              const Message& message, std::string fix, StatementPart part = {}) const {
    values.report(prim, property, severity, rule, message, std::move(fix), std::move(part));
  }
  void not_read(const stage::Prim& prim, std::string property, std::string why) {
    scene.not_read.push_back({prim.path(), std::move(property), std::move(why)});
  }

 private:
  std::uint32_t object_at(Path path, const std::vector<std::uint32_t>& object_of_prim) const {
    const std::uint32_t found = walk.index_of(path);
    return found == kNone ? kNone : object_of_prim[found];
  }
};

/// Prims of walk.prims for which `wanted(prim)` holds, sorted by path.
template <class Wanted>
std::vector<std::uint32_t> sorted_prims(const Walk& walk, Wanted wanted) {
  std::vector<std::uint32_t> found;
  for (const std::uint32_t i : walk.by_path) {
    if (wanted(walk.prims[i])) {
      found.push_back(i);
    }
  }
  return found;
}

/// One collider as it is at the time of `state.values`, without its material.
std::optional<Collider> read_collider(ReadState& state, const PhysicsPrim& found,
                                      std::optional<SolidIntegrals>& integrals);
/// The attribute of an articulation root that says whether its links touch each other; empty where
/// none is authored (S-115).
Token self_collision_property(const ReadState& state, const PhysicsPrim& root);
/// Mass, centre and inertia of one body from the colliders that it has in the scene.
void compute_body_mass(ReadState& state, Index body);

// The passes, in the order in which they run; each needs those before it.
void read_scenes(ReadState& state);
void read_bodies(ReadState& state);
void read_materials(ReadState& state);
void read_colliders(ReadState& state);
void bind_materials(ReadState& state);
void read_masses(ReadState& state);
void read_body_settings(ReadState& state);
void read_joints(ReadState& state);
void read_drives(ReadState& state);
void read_actuators(ReadState& state);
void read_tendons(ReadState& state);
void read_physx_tendons(ReadState& state);
void read_mujoco_actuators(ReadState& state);
void read_joint_settings(ReadState& state);
void read_limit_springs(ReadState& state);
void read_mimics(ReadState& state);
void read_gears(ReadState& state);
void read_articulations(ReadState& state);
void read_collision_groups(ReadState& state);
void read_filtered_pairs(ReadState& state);
void read_tracks(ReadState& state);
void read_moving_shapes(ReadState& state);
void read_nesting(ReadState& state);
void read_object_tracks(ReadState& state);
/// The passes before read_tracks(), which read a stage as it is at one time.
void read_objects(ReadState& state);
void read_sensors(ReadState& state);
void note_what_is_not_read(ReadState& state);
/// Lists attributes that vary over time and whose value at the start counts for good (S-116). After
/// all passes that follow samples.
void note_frozen_samples(ReadState& state);

}  // namespace tenon::physics
