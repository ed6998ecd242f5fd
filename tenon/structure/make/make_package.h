// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/function.h"
#include "tenon/base/result.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/bytes/files.h"
#include "tenon/compose/layer_opener.h"
#include "tenon/layer/layer.h"
#include "tenon/structure/layout.h"
#include "tenon/structure/make/asset_facts.h"
#include "tenon/structure/package.h"

namespace tenon::structure {

/// An asset and the way to what it needs. Nothing of it is changed.
struct AssetSource {
  layer::LayerPtr root;
  compose::LayerOpener open_layer;
  /// As in stage::StageOptions.
  Function<std::string(const std::string& asset_path, const layer::Layer& anchor)> resolve_asset;
  /// The bytes of a resolved asset: a texture, a module of a material.
  Function<Result<std::shared_ptr<const bytes::FileBytes>>(const std::string& identifier)>
      open_asset;
  /// Units of work of composition, as in compose::ComposeOptions; 0: the limit.
  std::size_t max_work = 0;
  bytes::Files files = {};  ///< where it it is looked up whether an asset that was refused is there
};

/// Vendors' schemas of joints (schema_generation.h); UsdPhysics is the same in all.
enum class SchemaGeneration : std::uint8_t {
  AsAuthored,  ///< no schema is exchanged
  Current,     ///< NewtonMimicAPI, PhysxJointAxisAPI
  Legacy,      ///< PhysxMimicJointAPI, PhysxJointAPI
  Both,        ///< side by side
};

/// Where the links of a robot stand (link_nesting.h).
enum class LinkNesting : std::uint8_t {
  AsAuthored,
  Flat,    ///< side by side
  Nested,  ///< each below the link that carries it by a joint
};

struct StructureOptions {
  Names names = Names::Current;
  /// Name of the interface without ending; empty: that of the default prim.
  std::string name;
  /// Meshes that collide are no instances, so that every engine's layer may tune them.
  bool overridable_colliders = false;
  /// Variants for PhysX and MuJoCo also where nothing is for them alone.
  bool all_engines = false;
  SchemaGeneration schema = SchemaGeneration::AsAuthored;
  LinkNesting links = LinkNesting::AsAuthored;
  /// Engines that get a variant and a layer over physics.usda, also where nothing is for them
  /// alone.
  std::vector<std::string> engines = {};
  /// isaac:robotType of the default prim, one of known_robot_types(); empty: as it is.
  std::string robot_type = {};
  /// As SimReady wants assets: a variant set for each engine (runtimes.h), UsdPhysics alone in
  /// physics.usda, with what materials have of it, meshes that are drawn and collide in one place
  /// once (one_mesh.h), and metadata.
  std::optional<AssetFacts> simready = std::nullopt;
};

struct StructuredAsset {
  Package package;
  std::vector<std::string> physics_variants;  ///< in the order of the interface; "none" first
  std::string selection;                      ///< of the set "Physics"
  /// Old path -> new path of prims that are not where they were: what was beside the default prim,
  /// links that were to be moved, meshes, which got a wrapper. What goes along with a prim above it
  /// is not named.
  std::map<Path, Path> moved;
};

/// Any USD asset in Asset Structure 3.0, stored and proven: each variant of what its bytes say
/// composes to what the source composes to, as far as it belongs into that variant, and has the
/// same neutral physics.
/// The result depends on what the source composes to alone, so that making it again from the result
/// changes no byte.
///
/// Per variant: what is for PhysX alone is in "physx" alone, and so on; "none" has no physics, and
/// colliders that are not visible are switched off there. Meshes get a wrapper where they have
/// none. Prims beside the default prim come below it, a PhysicsScene for one. Robots get
/// IsaacRobotAPI with links and joints in kinematic order where they have none.
/// With `simready` the variant "physics" is what is for no engine, and each runtime's set is proven
/// as the others are, over it.
///
/// Errors: ErrorCode::NotFound without a default prim; Invalid "structure.differs" when the proof
/// fails, with the prim or the file where it does; those of opening. Diagnostics:
/// "structure.asset-missing".
Result<StructuredAsset> make_package(const AssetSource& source, const StructureOptions& options,
                                     Diagnostics& diagnostics);

}  // namespace tenon::structure
