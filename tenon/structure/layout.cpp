// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The structure is a set of tables: files by role, owners by prefix of a name, arcs by the roles
// that they lead from and to. In a table of owners the first row that fits counts, so longer
// prefixes stand before the shorter ones that they begin with. A property is judged by its name,
// then by the applied API schema that declares it, then by the type of its prim.
#include "tenon/structure/layout.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "tenon/schema/registry.h"

namespace tenon::structure {
namespace {

struct FileRow {
  Role role;
  std::string_view name;          ///< of messages
  std::string_view current_stem;  ///< of file names, without ending
  std::string_view tutorial_stem;
  std::string_view current;  ///< place in the asset's folder
  std::string_view tutorial;
  std::string_view scope;
};

constexpr FileRow kFiles[] = {
    {Role::Other, "other", "", "", "", "", ""},
    {Role::Interface, "interface", "", "", "", "", ""},
    {Role::Base, "base", "base", "base", "payloads/base.usda", "payloads/base.usda", ""},
    {Role::Geometries, "geometries", "geometries", "geometry", "payloads/geometries.usd",
     "payloads/geometry.usdc", "Geometries"},
    {Role::Materials, "materials", "materials", "material", "payloads/materials.usda",
     "payloads/material.usda", "Materials"},
    {Role::Instances, "instances", "instances", "instances", "payloads/instances.usda",
     "payloads/instances.usda", "Instances"},
    {Role::Robot, "robot", "robot", "robot", "payloads/robot.usda", "payloads/robot.usda", ""},
    {Role::Physics, "physics", "physics", "physics", "payloads/Physics/physics.usda",
     "payloads/Physics/physics.usda", ""},
    {Role::Physx, "physx", "physx", "physx", "payloads/Physics/physx.usda",
     "payloads/Physics/physx.usda", ""},
    {Role::Mujoco, "mujoco", "mujoco", "mujoco", "payloads/Physics/mujoco.usda",
     "payloads/Physics/mujoco.usda", ""},
    {Role::Newton, "newton", "newton", "newton", "payloads/Physics/newton.usda",
     "payloads/Physics/newton.usda", ""},
    {Role::Engine, "engine", "", "", "", "", ""},
    {Role::Variant, "variant", "", "", "", "", ""},
};

const FileRow& row_of(Role role) { return kFiles[static_cast<std::size_t>(role)]; }

// What each row says holds for names that begin with it; the first row that fits counts.
struct OwnerRow {
  std::string_view prefix;
  Ownership ownership;
};

constexpr RoleSet kEngines(Role::Physx, Role::Mujoco, Role::Newton, Role::Engine);
constexpr RoleSet kPhysicsFiles(Role::Physx, Role::Mujoco, Role::Newton, Role::Engine,
                                Role::Variant);
constexpr RoleSet kAnyCollider(Role::Base, Role::Instances, Role::Physx, Role::Mujoco, Role::Newton,
                               Role::Engine, Role::Variant);
constexpr RoleSet kAnyMaterial(Role::Base, Role::Materials, Role::Instances, Role::Physx,
                               Role::Mujoco, Role::Newton, Role::Engine, Role::Variant);
/// The mass of one of several colliders of a body.
constexpr RoleSet kColliderMass(Role::Instances, Role::Physx, Role::Mujoco, Role::Newton,
                                Role::Engine, Role::Variant);
constexpr RoleSet kVendorCollider(Role::Instances, Role::Engine, Role::Variant);
constexpr RoleSet kVendorMaterial(Role::Materials, Role::Instances, Role::Engine, Role::Variant);
constexpr RoleSet kVendor(Role::Engine, Role::Variant);

constexpr OwnerRow kApis[] = {
    {"PhysicsCollisionAPI", {Role::Physics, kAnyCollider}},
    {"PhysicsMeshCollisionAPI", {Role::Physics, kAnyCollider}},
    {"NewtonCollisionAPI", {Role::Physics, kAnyCollider}},
    {"NewtonMeshCollisionAPI", {Role::Physics, kAnyCollider}},
    {"NewtonSDFCollisionAPI", {Role::Physics, kAnyCollider}},
    {"PhysicsMassAPI", {Role::Physics, kColliderMass}},
    {"NewtonMassAPI", {Role::Physics, kColliderMass}},
    {"PhysicsMaterialAPI", {Role::Physics, kAnyMaterial}},
    {"NewtonMaterialAPI", {Role::Physics, kAnyMaterial}},
    {"PhysxMaterialAPI", {Role::Physx, kVendorMaterial}},
    {"MjcMaterialAPI", {Role::Mujoco, kVendorMaterial}},
    {"PhysxCollisionAPI", {Role::Physx, kVendorCollider}},
    {"PhysxConvex", {Role::Physx, kVendorCollider}},
    {"PhysxTriangleMesh", {Role::Physx, kVendorCollider}},
    {"PhysxSDFMeshCollisionAPI", {Role::Physx, kVendorCollider}},
    {"PhysxSphereFillCollisionAPI", {Role::Physx, kVendorCollider}},
    {"PhysxMeshMergeCollisionAPI", {Role::Physx, kVendorCollider}},
    {"MjcCollisionAPI", {Role::Mujoco, kVendorCollider}},
    {"MjcMeshCollisionAPI", {Role::Mujoco, kVendorCollider}},
    {"MjcImageableAPI", {Role::Mujoco, kVendorCollider}},
    {"Physics", {Role::Physics, kPhysicsFiles}},
    {"Newton", {Role::Physics, kPhysicsFiles}},
    {"Physx", {Role::Physx, kVendor}},
    {"OmniPhysics", {Role::Physx, kVendor}},
    {"Mjc", {Role::Mujoco, kVendor}},
    {"TenonMujoco", {Role::Mujoco, kVendor}},
    {"Isaac", {Role::Robot, RoleSet(Role::Physics, Role::Variant)}},
    {"MaterialBindingAPI",
     {Role::Base, RoleSet(Role::Instances, Role::Physics, Role::Physx, Role::Mujoco, Role::Newton,
                          Role::Engine, Role::Variant)}},
    {"NodeDefAPI", {Role::Materials, RoleSet(Role::Base, Role::Instances, Role::Variant)}},
};

// Prefixes of property names. Physics may hold what describes its joints to robot tools.
constexpr OwnerRow kProperties[] = {
    {"physics:approximation", {Role::Physics, kAnyCollider}},
    {"physics:collisionEnabled", {Role::Physics, kAnyCollider}},
    {"physics:simulationOwner", {Role::Physics, kAnyCollider}},
    {"physics:staticFriction", {Role::Physics, kAnyMaterial}},
    {"physics:dynamicFriction", {Role::Physics, kAnyMaterial}},
    {"physics:restitution", {Role::Physics, kAnyMaterial}},
    {"physics:density", {Role::Physics, kAnyMaterial}},
    {"physics:mass", {Role::Physics, kColliderMass}},
    {"physics:centerOfMass", {Role::Physics, kColliderMass}},
    {"physics:diagonalInertia", {Role::Physics, kColliderMass}},
    {"physics:principalAxes", {Role::Physics, kColliderMass}},
    {"newton:inertia", {Role::Physics, kColliderMass}},
    {"physics:", {Role::Physics, kPhysicsFiles}},
    {"drive:", {Role::Physics, kPhysicsFiles}},
    {"limit:", {Role::Physics, kPhysicsFiles}},
    {"state:", {Role::Physics, kPhysicsFiles}},
    {"urdf:", {Role::Physics, kPhysicsFiles}},
    {"newton:contact", {Role::Physics, kAnyMaterial}},
    {"newton:maxHullVertices", {Role::Physics, kAnyCollider}},
    {"newton:torsionalFriction", {Role::Physics, kAnyMaterial}},
    {"newton:rollingFriction", {Role::Physics, kAnyMaterial}},
    {"newton:", {Role::Physics, kPhysicsFiles}},
    {"physxMaterial:", {Role::Physx, kVendorMaterial}},
    {"physxCollision:", {Role::Physx, kVendorCollider}},
    {"physxConvex", {Role::Physx, kVendorCollider}},
    {"physxTriangleMesh", {Role::Physx, kVendorCollider}},
    {"physxSDFMeshCollision:", {Role::Physx, kVendorCollider}},
    {"physxSphereFillCollision:", {Role::Physx, kVendorCollider}},
    {"physx", {Role::Physx, kVendor}},
    {"omniphysics:", {Role::Physx, kVendor}},
    {"mjc:option:", {Role::Mujoco, kVendor}},
    {"mjc:", {Role::Mujoco, kVendorMaterial}},
    {"tenon:mujoco:sensor", {Role::Mujoco, kVendor}},
    {"isaac:", {Role::Robot, RoleSet(Role::Physics, Role::Variant)}},
    {"material:binding:physics", {Role::Physics, kAnyCollider}},
    {"material:binding:collection:physics:", {Role::Physics, kAnyCollider}},
    {"material:binding", {Role::Base, RoleSet(Role::Instances, Role::Variant)}},
    {"xformOp", {Role::Base, RoleSet(Role::Instances, Role::Variant)}},
    {"purpose", {Role::Base, RoleSet(Role::Instances, Role::Variant)}},
    {"visibility", {Role::Base, RoleSet(Role::Instances, Role::Variant)}},
    {"proxyPrim", {Role::Base, RoleSet(Role::Instances, Role::Variant)}},
    {"primvars:displayColor", {Role::Base, RoleSet(Role::Instances, Role::Variant)}},
    {"primvars:displayOpacity", {Role::Base, RoleSet(Role::Instances, Role::Variant)}},
};

constexpr Ownership kGeometry{Role::Geometries, RoleSet(Role::Variant)};
constexpr Ownership kMaterial{Role::Materials, RoleSet(Role::Base, Role::Instances, Role::Variant)};
constexpr Ownership kBase{Role::Base, RoleSet(Role::Instances, Role::Variant)};
/// With all that it says, its place included.
constexpr Ownership kNamedPose{Role::Robot, RoleSet(Role::Base, Role::Physics, Role::Variant)};

template <std::size_t count>
const OwnerRow* find_row(const OwnerRow (&rows)[count], std::string_view name) {
  const char first = name.empty() ? '\0' : name.front();
  const auto* found = std::find_if(std::begin(rows), std::end(rows), [&](const OwnerRow& row) {
    return row.prefix.front() == first && name.starts_with(row.prefix);
  });
  return found == std::end(rows) ? nullptr : found;
}

/// Prims that only hold others: what they own by their type is not their properties.
bool is_holder(Token type) {
  static const Token scope("Scope");
  static const Token xform("Xform");
  const schema::Registry& registry = schema::Registry::instance();
  return registry.is_a(type, scope) || registry.is_a(type, xform);
}

/// The API schema of the list that declares the property; those of the base are not looked at.
Token declaring_api(Token property, std::span<const Token> apis) {
  for (const Token& api : apis) {
    if (find_row(kApis, api.view()) == nullptr) {
      continue;
    }
    const schema::PrimDefinition definition(Token(), {api});
    if (definition.find(property) != nullptr) {
      return api;
    }
  }
  return {};
}

constexpr Replacement kReplacements[] = {
    {"PhysxJointAPI", "NewtonJointAPI, or PhysxJointAxisAPI for one axis"},
    {"PhysxMimicJointAPI", "NewtonMimicAPI"},
    {"IsaacReferencePointAPI", "IsaacSiteAPI"},
};

struct ArcRow {
  Role from;
  Arc arc;
  RoleSet to;
};

constexpr ArcRow kArcs[] = {
    {Role::Interface, Arc::Reference, RoleSet(Role::Base)},
    {Role::Interface, Arc::Payload,
     RoleSet(Role::Physics, Role::Physx, Role::Mujoco, Role::Newton, Role::Engine, Role::Variant)},
    {Role::Base, Arc::SubLayer, RoleSet(Role::Robot)},
    {Role::Base, Arc::Reference, RoleSet(Role::Robot, Role::Instances, Role::Materials)},
    {Role::Instances, Arc::Reference, RoleSet(Role::Geometries, Role::Materials)},
    {Role::Materials, Arc::Asset, RoleSet(Role::Other)},
    {Role::Base, Arc::Asset, RoleSet(Role::Other)},
    {Role::Physx, Arc::SubLayer, RoleSet(Role::Physics)},
    {Role::Mujoco, Arc::SubLayer, RoleSet(Role::Physics)},
    {Role::Newton, Arc::SubLayer, RoleSet(Role::Physics)},
    {Role::Engine, Arc::SubLayer, RoleSet(Role::Physics)},
};

}  // namespace

std::vector<std::string> known_names() { return {"current", "tutorial"}; }

std::string_view role_name(Role role) { return row_of(role).name; }

std::string file_name(Role role, Names names) {
  const FileRow& row = row_of(role);
  return std::string(names == Names::Current ? row.current : row.tutorial);
}

bool is_engine(Role role) { return kEngines.contains(role); }

std::span<const std::string_view> known_physics_variants() {
  static const std::array<std::string_view, 4> names{
      role_name(Role::Physx), role_name(Role::Mujoco), role_name(Role::Newton),
      role_name(Role::Physics)};
  return names;
}

Role role_of_physics_variant(std::string_view variant) {
  for (const Role role : {Role::Physics, Role::Physx, Role::Mujoco, Role::Newton}) {
    if (variant == role_name(role)) {
      return role;
    }
  }
  return Role::Engine;
}

Role role_of_file_name(std::string_view place) {
  const std::size_t dot = place.rfind('.');
  const std::string_view ending = dot == std::string_view::npos ? "" : place.substr(dot);
  if (ending != ".usd" && ending != ".usda" && ending != ".usdc") {
    return Role::Other;
  }
  place = place.substr(0, dot);
  constexpr std::string_view kFolder = "payloads/";
  if (!place.starts_with(kFolder)) {
    return place.find('/') == std::string_view::npos ? Role::Interface : Role::Other;
  }
  place.remove_prefix(kFolder.size());
  const std::size_t slash = place.find('/');
  if (slash == std::string_view::npos) {
    for (const FileRow& row : kFiles) {
      const bool payload = !row.current.empty() && row.role < Role::Physics;
      if (payload && (place == row.current_stem || place == row.tutorial_stem)) {
        return row.role;
      }
    }
    return Role::Other;
  }
  const std::string_view name = place.substr(slash + 1);
  if (name.find('/') != std::string_view::npos) {
    return Role::Other;
  }
  return place.substr(0, slash) == kPhysicsSet ? role_of_physics_variant(name) : Role::Variant;
}

std::string_view root_scope(Role role) { return row_of(role).scope; }

std::string_view instance_material_scope(Names names) {
  return names == Names::Current ? "VisualMaterials" : "Materials";
}

Ownership owner_of_type(Token type) {
  if (type == kNamedPoseType) {
    return kNamedPose;
  }
  if (type == "Mesh") {
    return kGeometry;
  }
  if (type == "GeomSubset") {  // where what it is a part of stands: points, for one
    return {Role::Geometries, RoleSet(Role::Base, Role::Variant)};
  }
  if (type == "Material" || type == "Shader" || type == "NodeGraph") {
    return kMaterial;
  }
  if (type == "Scope" || type == "Xform") {
    // Joints are in a scope; materials of an instance and named poses of a robot in others.
    return {Role::Base, RoleSet(Role::Interface, Role::Geometries, Role::Materials, Role::Instances,
                                Role::Robot, Role::Physics, Role::Physx, Role::Mujoco, Role::Newton,
                                Role::Engine, Role::Variant)};
  }
  const OwnerRow* row = find_row(kApis, type.view());
  static const Token xformable("Xformable");
  const bool is_place = row != nullptr && row->ownership.owner == Role::Robot &&
                        schema::Registry::instance().is_a(type, xformable);
  // A sensor stands on its link, in the kinematic tree.
  return row == nullptr || is_place ? kBase : row->ownership;
}

Ownership owner_of_api(Token api) {
  const OwnerRow* row = find_row(kApis, api.view());
  return row == nullptr ? kBase : row->ownership;
}

Ownership owner_of_property(Token property, Token type, std::span<const Token> apis) {
  if (type == kNamedPoseType) {
    return kNamedPose;
  }
  if (const OwnerRow* row = find_row(kProperties, property.view())) {
    return row->ownership;
  }
  if (const Token api = declaring_api(property, apis); !api.empty()) {
    const Ownership owner = owner_of_api(api);
    if (owner.owner != Role::Base) {
      return owner;
    }
  }
  const Ownership own = owner_of_type(type);
  if (own.owner == Role::Geometries || own.owner == Role::Materials) {
    return own;  // no holders
  }
  return type.empty() || own.also == kBase.also || is_holder(type) ? kBase : own;
}

Ownership owner_of_metadata(Token field) {
  if (field == "variantSetNames" || field == "variantSelection") {
    return {Role::Interface, RoleSet(Role::Variant)};
  }
  if (field == "active") {
    return {Role::Base, RoleSet(Role::Physics, Role::Physx, Role::Mujoco, Role::Newton,
                                Role::Engine, Role::Variant)};
  }
  if (field == "kind" || field == "assetInfo" || field == "instanceable") {
    return {Role::Base, RoleSet(Role::Interface, Role::Instances, Role::Variant)};
  }
  // Names for people, documentation, data of tools: with what they describe.
  return {Role::Base, RoleSet(Role::Interface, Role::Geometries, Role::Materials, Role::Instances,
                              Role::Robot, Role::Physics, Role::Physx, Role::Mujoco, Role::Newton,
                              Role::Engine, Role::Variant)};
}

Role file_for(Role owner, bool in_instance) {
  const bool own_file = owner == Role::Geometries || owner == Role::Materials;
  return in_instance && !own_file ? Role::Instances : owner;
}

std::string_view arc_name(Arc arc) {
  constexpr std::string_view kNames[] = {"sublayer", "reference", "payload", "asset"};
  return kNames[static_cast<std::size_t>(arc)];
}

bool may_lead(Role from, Arc arc, Role to) {
  if (from == Role::Variant) {
    return true;  // what a payload of another set needs is its own affair
  }
  return std::any_of(std::begin(kArcs), std::end(kArcs), [&](const ArcRow& row) {
    return row.from == from && row.arc == arc && row.to.contains(to);
  });
}

const Replacement* replacement_of(std::string_view api) {
  const std::string_view name = api.substr(0, api.find(':'));
  const auto* found = std::find_if(std::begin(kReplacements), std::end(kReplacements),
                                   [&](const Replacement& row) { return row.legacy == name; });
  return found == std::end(kReplacements) ? nullptr : found;
}

}  // namespace tenon::structure
