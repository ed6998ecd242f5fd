// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/token.h"
#include "tenon/layer/layer.h"

/// Asset Structure 3.0 as a table: which file of an asset owns what. The splitter, the rules of
/// `tenon check --profile isaac-3.0` and the edits of `tenon set` all read this one.
/// Sources: Isaac Sim 6 tutorial "Asset Structure", and the packages that its importers write.
namespace tenon::structure {

/// What a file is for in an asset of this structure.
enum class Role : std::uint8_t {
  Other,       ///< no part of the structure
  Interface,   ///< `<robot>.usda`: arcs and variant sets, no opinions of its own
  Base,        ///< kinematic tree, transforms, shapes other than meshes
  Geometries,  ///< meshes, binary; nothing else
  Materials,   ///< materials and shaders
  Instances,   ///< mesh + material + collider, to be referenced by the base
  Robot,       ///< what the asset is as a robot; overs only
  Physics,     ///< physics for every engine: UsdPhysics and Newton schemas
  Physx,       ///< on top of Physics, for PhysX alone
  Mujoco,      ///< on top of Physics, for MuJoCo alone
  Newton,      ///< on top of Physics, for Newton alone
  Engine,      ///< on top of Physics, a variant of another name
  Variant,     ///< payload of a variant of another set: `payloads/<Set>/<variant>.usda`
};

/// A small set of roles.
class RoleSet {
 public:
  constexpr RoleSet() = default;
  template <class... Roles>
  constexpr explicit RoleSet(Roles... roles) : bits_((0u | ... | bit(roles))) {}
  constexpr bool contains(Role role) const { return (bits_ & bit(role)) != 0; }
  constexpr bool operator==(const RoleSet&) const = default;

 private:
  static constexpr std::uint32_t bit(Role role) { return 1u << static_cast<unsigned>(role); }
  std::uint32_t bits_ = 0;
};

/// The two generations of names that are in use.
enum class Names : std::uint8_t {
  Current,   ///< Isaac Sim 6: geometries.usd, materials.usda, scope VisualMaterials
  Tutorial,  ///< its tutorial: geometry.usdc, material.usda, scope Materials
};

/// "current", "tutorial".
std::vector<std::string> known_names();

/// "base", "physx", ...; "interface", "variant", "other" for those without a name of their own.
std::string_view role_name(Role role);
/// The file's place in the asset's folder: "payloads/base.usda". Empty for Interface, Engine,
/// Variant and Other, whose names depend on the asset.
std::string file_name(Role role, Names names = Names::Current);
/// Role of a file by its place in the asset's folder, in either generation; files of the formats
/// usda, usdc and usd alike. A file at the top is the Interface, one in `payloads/<Set>/` a
/// Variant.
Role role_of_file_name(std::string_view place);
/// Variants of the set "Physics" that have a role of their own, the strongest first: those of
/// engines, then "physics".
std::span<const std::string_view> known_physics_variants();
/// Role of the variant of the set "Physics": Physics, Physx, Mujoco, Newton, else Engine.
Role role_of_physics_variant(std::string_view variant);
/// Physx, Mujoco, Newton and Engine.
bool is_engine(Role role);

/// Scope at the top of the files that hold prims to be referenced: "Geometries", "Instances",
/// "Materials"; empty for others, whose top is the robot's prim.
std::string_view root_scope(Role role);
/// Name of the scope that holds materials in each of the instances.
std::string_view instance_material_scope(Names names);
/// Below the robot's prim: joints, scenes and the like; links when they are nested; materials.
inline constexpr std::string_view kPhysicsScope = "Physics";
inline constexpr std::string_view kGeometryScope = "Geometry";
inline constexpr std::string_view kMaterialScope = "Materials";
/// Below the robot's prim, in the robot's file: postures by name, and their type.
inline constexpr std::string_view kNamedPosesScope = "Named_Poses";
inline constexpr std::string_view kNamedPoseType = "IsaacNamedPose";
/// The variant set that chooses an engine, and its variant without physics.
inline constexpr std::string_view kPhysicsSet = "Physics";
inline constexpr std::string_view kNoVariant = "none";

/// Who owns a piece of an asset, and which other files may hold it as well.
struct Ownership {
  Role owner = Role::Base;
  RoleSet also;

  bool may_be_in(Role role) const { return role == owner || also.contains(role); }
};

/// A prim's own definition: its type and that it exists. "" is a prim without a type.
Ownership owner_of_type(Token type);
/// An entry of apiSchemas, with or without its instance name, known to a schema registry or not.
Ownership owner_of_api(Token api);
/// A property of a prim of that type with these API schemas. The name decides where it has a
/// vendor's prefix, then the schema that declares it, then the type.
Ownership owner_of_property(Token property, Token type, std::span<const Token> apis);
/// A metadata field of a prim or property; arcs are no metadata (see may_lead).
Ownership owner_of_metadata(Token field);

/// The target file of a piece. What instances share can be changed in the file of the instances
/// alone: opinions on it from elsewhere are not composed.
Role file_for(Role owner, bool in_instance);

enum class Arc : std::uint8_t { SubLayer, Reference, Payload, Asset };
/// "sublayer", "reference", "payload" or "asset".
std::string_view arc_name(Arc arc);
/// The structure has arcs of this kind from files of one role to files of another. A payload of
/// the interface belongs into a variant. To Other: textures and modules of materials.
bool may_lead(Role from, Arc arc, Role to);

/// A schema name that current engines no longer read, and its replacement.
struct Replacement {
  std::string_view legacy;
  std::string_view current;
};
/// Null for names that are current.
const Replacement* replacement_of(std::string_view api);

/// Roles by layer identifier.
using RolesOfFiles = std::map<std::string, Role>;

/// Which file plays which role in the asset that `interface` opens: first by the arcs that lead
/// there from the interface, whether the layer is open or not, then by name. `layers` are those
/// whose arcs are followed; the interface need not be among them. Empty when the default prim of
/// `interface` has no reference to a base, which is to say that the asset has not this structure.
RolesOfFiles roles_of_files(const layer::Layer& interface,
                            const std::vector<layer::LayerPtr>& layers);

/// The identifier of the file that an asset path of a layer means, without looking whether there
/// is one: relative paths are taken from the layer's folder.
std::string target_of(std::string_view asset_path, const layer::Layer& anchor);

}  // namespace tenon::structure
