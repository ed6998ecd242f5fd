// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What belongs to an engine is told by the prefixes of names, as SimReady's rules tell it. Each
// number of Newton's joints is copied into the schema of the engine where that lacks it:
// a table has both names and the unit. The rest is what the rules ask each joint and collider for.
#include "tenon/structure/make/runtimes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "tenon/layer/fields.h"
#include "tenon/physics/attribute_values.h"
#include "tenon/schema/registry.h"
#include "tenon/structure/layer_tree.h"

namespace tenon::structure {
namespace {

namespace fields = layer::fields;
using layer::Layer;
using layer::Spec;
using layer::Value;

constexpr Runtime kRuntimes[] = {
    {"PhysX", Role::Physx, "runnables/physics/physx.usda"},
    {"Newton", Role::Newton, "runnables/physics/newton.usda"},
    {"MuJoCo", Role::Mujoco, "runnables/physics/mujoco.usda"},
};

/// The effort that Newton takes where none is said, and its rules ask for a finite one [N m, N].
constexpr double kAnyEffort = 1e6;
/// PhysX's own greatest velocity of a joint: none [degree/s, m/s].
constexpr double kAnyVelocity = 1e6;
/// A mimic has to have one [rad/s]; with a damping ratio of 0 PhysX couples rigidly all the same.
constexpr double kMimicFrequency = 25;
constexpr double kPerRadian = 180 / std::numbers::pi;

const Spec* spec_with_value(const Layer& content, Path prim, const std::string& name) {
  const Spec* spec = content.find(prim.property(Token(name)));
  return spec != nullptr && spec->has(fields::default_value) ? spec : nullptr;
}

double number_at(const Layer& content, Path prim, const std::string& name, double fallback) {
  const Spec* spec = spec_with_value(content, prim, name);
  return spec == nullptr
             ? fallback
             : physics::number_of(*spec->find(fields::default_value)).value_or(fallback);
}

Token token_at(const Layer& content, Path prim, const char* name) {
  const Spec* spec = spec_with_value(content, prim, name);
  return spec == nullptr ? Token() : spec->get_or(fields::default_value, Token());
}

/// As the schema or the typed prim `owner` declares it.
void write_value(Layer& content, Path prim, Token owner, const std::string& name, Value value) {
  const bool typed = schema::Registry::instance().is_a(type_of(content, prim), owner);
  const schema::PrimDefinition definition(typed ? owner : Token(),
                                          typed ? std::vector<Token>() : std::vector<Token>{owner});
  Spec spec;
  spec.kind = layer::SpecKind::Attribute;
  spec.set(fields::custom, false);
  if (const schema::PropertyDefinition* known = definition.find(Token(name))) {
    spec.set(fields::typeName, Value(known->type_name));
    spec.set(fields::variability, Value(known->variability));
  }
  spec.set(fields::default_value, std::move(value));
  put_property(content, prim.property(Token(name)), spec);
}

/// MuJoCo's schemas declare doubles, the others floats.
void write_number(Layer& content, Path prim, Token owner, const std::string& name, double value) {
  const bool wide = name.starts_with("mjc:");
  write_value(content, prim, owner, name, wide ? Value(value) : Value(static_cast<float>(value)));
}

void write_target(Layer& content, Path prim, const char* name, Path target) {
  Spec spec;
  spec.kind = layer::SpecKind::Relationship;
  spec.set(fields::custom, false);
  set_targets(spec, {target});
  put_property(content, prim.property(Token(name)), spec);
}

/// "angular" or "linear"; empty for joints of no or of several axes.
std::string drive_axis(const Layer& content, Path joint) {
  const Token type = type_of(content, joint);
  return type == "PhysicsRevoluteJoint"    ? "angular"
         : type == "PhysicsPrismaticJoint" ? "linear"
                                           : "";
}

bool has_drive(const Layer& content, Path joint) {
  const std::vector<Token> apis = apis_of(content, joint);
  return std::any_of(apis.begin(), apis.end(),
                     [](Token api) { return api.view().starts_with("PhysicsDriveAPI:"); });
}

/// Joints of articulations that leave some freedom.
std::vector<Path> moving_joints(const Layer& content) {
  const auto& registry = schema::Registry::instance();
  std::vector<Path> joints;
  for (const Path& prim : prims_below(content)) {
    const Token type = type_of(content, prim);
    const Spec* excluded = spec_with_value(content, prim, "physics:excludeFromArticulation");
    if (is_active(content, prim) && registry.is_a(type, "PhysicsJoint") &&
        !registry.is_a(type, "PhysicsFixedJoint") &&
        (excluded == nullptr || !excluded->get_or(fields::default_value, false))) {
      joints.push_back(prim);
    }
  }
  return joints;
}

/// A mesh that is not drawn: part of an instance, where no other layer has a say.
bool is_shared_collider(const Layer& content, Path prim) {
  return type_of(content, prim) == "Mesh" && token_at(content, prim, "purpose") == "guide";
}

/// A number of NewtonJointAPI in another schema; {axis} is "angular" or "linear".
struct JointRow {
  Role role;
  const char* newton;
  const char* api;
  const char* name;
  bool per_degree;  ///< of a joint that turns: Newton's is per degree, this one per radian
};

constexpr JointRow kJoints[] = {
    {Role::Physx, "newton:armature", "PhysxJointAxisAPI:", "armature", false},
    {Role::Physx, "newton:velocityLimit", "PhysxJointAxisAPI:", "maxJointVelocity", false},
    {Role::Physx, "newton:friction", "PhysxJointAxisAPI:", "staticFrictionEffort", false},
    {Role::Physx, "newton:friction", "PhysxJointAxisAPI:", "dynamicFrictionEffort", false},
    {Role::Physx, "newton:damping", "PhysxJointAxisAPI:", "viscousFrictionCoefficient", false},
    {Role::Mujoco, "newton:armature", "MjcJointAPI", "mjc:armature", false},
    {Role::Mujoco, "newton:friction", "MjcJointAPI", "mjc:frictionloss", false},
    {Role::Mujoco, "newton:damping", "MjcJointAPI", "mjc:damping", true},
};

void copy_joint_numbers(Layer& content, Path joint, Role role) {
  const std::string axis = drive_axis(content, joint);
  for (const JointRow& row : kJoints) {
    if (row.role != role || axis.empty() ||
        spec_with_value(content, joint, row.newton) == nullptr) {
      continue;
    }
    const bool of_axis = std::string_view(row.api).ends_with(':');
    const std::string api = of_axis ? row.api + axis : row.api;
    const std::string name = of_axis ? "physxJointAxis:" + axis + ":" + row.name : row.name;
    const double factor = row.per_degree && axis == "angular" ? kPerRadian : 1;
    const double value = number_at(content, joint, row.newton, 0) * factor;
    if (spec_with_value(content, joint, name) == nullptr && std::isfinite(value)) {
      add_api(content, joint, Token(api));
      write_number(content, joint, Token(api), name, value);
    }
  }
}

/// What Newton and PhysX have to find on each joint: a drive with a stiffness, for Newton with an
/// effort.
void complete_drive(Layer& content, Path joint, bool with_effort) {
  const std::string axis = drive_axis(content, joint);
  if (axis.empty()) {
    return;
  }
  const Token api("PhysicsDriveAPI:" + axis);
  const std::string prefix = "drive:" + axis + ":physics:";
  const bool is_new = !has_api(content, joint, api.view());
  add_api(content, joint, api);
  for (const char* name : {"damping", "stiffness"}) {
    if (spec_with_value(content, joint, prefix + name) == nullptr) {
      write_number(content, joint, api, prefix + name, 0);
    }
  }
  if (is_new ||
      (with_effort && !std::isfinite(number_at(content, joint, prefix + "maxForce",
                                               std::numeric_limits<double>::infinity())))) {
    write_number(content, joint, api, prefix + "maxForce", kAnyEffort);
  }
}

/// PhysxJointAPI asks for a velocity; where it has no number at all it goes.
void complete_physx_joint(Layer& content, Path joint) {
  const Token api("PhysxJointAPI");
  if (!has_api(content, joint, api.view()) ||
      spec_with_value(content, joint, "physxJoint:maxJointVelocity") != nullptr) {
    return;
  }
  const std::vector<Path> properties = properties_of(content, joint);
  if (std::any_of(properties.begin(), properties.end(), [](Path property) {
        return property.name().view().starts_with("physxJoint:");
      })) {
    write_number(content, joint, api, "physxJoint:maxJointVelocity", kAnyVelocity);
    return;
  }
  std::vector<Token> apis = apis_of(content, joint);
  std::erase(apis, api);
  set_apis(*content.find(joint), std::move(apis));
}

void complete_physx(Layer& content) {
  for (const Path& joint : moving_joints(content)) {
    copy_joint_numbers(content, joint, Role::Physx);
    bool follows = false;
    for (const Token api : apis_of(content, joint)) {
      const auto [name, instance] = schema::split_api_name(api);
      if (name == "PhysxMimicJointAPI") {
        follows = true;
        const std::string prefix = "physxMimicJoint:" + instance.str() + ":";
        if (number_at(content, joint, prefix + "naturalFrequency", 0) == 0) {
          write_number(content, joint, api, prefix + "naturalFrequency", kMimicFrequency);
          write_number(content, joint, api, prefix + "dampingRatio", 0);
        }
      }
    }
    if (!follows || has_drive(content, joint)) {
      complete_drive(content, joint, false);
    }
    complete_physx_joint(content, joint);
  }
}

void complete_newton(Layer& content) {
  std::set<Path> targeted;
  for (const Path& prim : prims_below(content)) {
    if (type_of(content, prim) == "NewtonActuator") {
      if (const Spec* targets = content.find(prim.property("newton:targets"))) {
        const std::vector<Path> all = targets_of(*targets);
        targeted.insert(all.begin(), all.end());
      }
    }
    if (type_of(content, prim) == "Mesh" && has_api(content, prim, "PhysicsMeshCollisionAPI") &&
        !is_shared_collider(content, prim) && !has_api(content, prim, "NewtonSDFCollisionAPI")) {
      add_api(content, prim, "NewtonMeshCollisionAPI");
    }
    if (has_api(content, prim, "PhysicsArticulationRootAPI") &&
        spec_with_value(content, prim, "newton:selfCollisionEnabled") == nullptr) {
      add_api(content, prim, "NewtonArticulationRootAPI");
      write_value(content, prim, "NewtonArticulationRootAPI", "newton:selfCollisionEnabled",
                  Value(true));
    }
  }
  for (const Path& joint : moving_joints(content)) {
    const bool moved = targeted.contains(joint) || has_api(content, joint, "NewtonMimicAPI");
    if (!moved || has_drive(content, joint)) {
      complete_drive(content, joint, true);
    }
  }
}

/// The actuator of a drive: its gains per radian; without gains the force that it is given.
void add_actuator(Layer& content, Path joint) {
  const std::string axis = drive_axis(content, joint);
  const Token type("MjcActuator");
  const Path prim = free_child(joint.parent(), joint.name().str() + "_actuator",
                               [&](Path path) { return content.has(path); });
  define_prim(content, prim, type);
  const double unit = axis == "angular" ? kPerRadian : 1;
  const std::string drive = "drive:" + axis + ":physics:";
  const bool follows = has_api(content, joint, "MjcEqualityJointAPI");
  const double stiffness = follows ? 0 : number_at(content, joint, drive + "stiffness", 0) * unit;
  const double damping = follows ? 0 : number_at(content, joint, drive + "damping", 0) * unit;
  const bool driven = stiffness != 0 || damping != 0;
  const double target = number_at(content, joint, drive + "targetPosition", 0) / unit;
  const double effort =
      number_at(content, joint, drive + "maxForce", std::numeric_limits<double>::infinity());
  if (driven) {
    write_value(content, prim, type, "mjc:biasPrm",
                Value(std::vector<double>{stiffness * target, 0 - stiffness, 0 - damping}));
    write_value(content, prim, type, "mjc:biasType", Value(Token("affine")));
  }
  if (std::isfinite(effort) && effort > 0) {
    write_number(content, prim, type, "mjc:forceRange:max", effort);
    write_number(content, prim, type, "mjc:forceRange:min", -effort);
  }
  write_value(content, prim, type, "mjc:gainPrm",
              Value(std::vector<double>{driven ? stiffness : 1}));
  write_value(content, prim, type, "mjc:gainType", Value(Token("fixed")));
  write_target(content, prim, "mjc:target", joint);
}

/// A law in degrees becomes one in radians.
void copy_mimic(Layer& content, Path joint) {
  const Spec* leader = content.find(joint.property("newton:mimicJoint"));
  const std::vector<Path> targets = leader == nullptr ? std::vector<Path>() : targets_of(*leader);
  if (targets.size() != 1 || has_api(content, joint, "MjcEqualityJointAPI")) {
    return;
  }
  const double unit = drive_axis(content, joint) == "angular" ? kPerRadian : 1;
  const double of_leader = drive_axis(content, targets.front()) == "angular" ? kPerRadian : 1;
  const Token api("MjcEqualityJointAPI");
  add_api(content, joint, api);
  write_number(content, joint, api, "mjc:coef0",
               number_at(content, joint, "newton:mimicCoef0", 0) / unit);
  write_number(content, joint, api, "mjc:coef1",
               number_at(content, joint, "newton:mimicCoef1", 1) * of_leader / unit);
  write_target(content, joint, "mjc:target", targets.front());
}

void complete_mujoco(Layer& content) {
  std::set<Path> targeted;
  for (const Path& prim : prims_below(content)) {
    if (type_of(content, prim) == "MjcActuator") {
      if (const Spec* target = content.find(prim.property("mjc:target"))) {
        const std::vector<Path> all = targets_of(*target);
        targeted.insert(all.begin(), all.end());
      }
    }
    if (!has_api(content, prim, "PhysicsCollisionAPI") || is_shared_collider(content, prim)) {
      continue;
    }
    add_api(content, prim, "MjcCollisionAPI");
    if (has_api(content, prim, "PhysicsMeshCollisionAPI")) {
      write_value(content, prim, "PhysicsMeshCollisionAPI", "physics:approximation",
                  Value(Token("convexHull")));
    }
  }
  for (const Path& joint : moving_joints(content)) {
    add_api(content, joint, "MjcJointAPI");
    copy_joint_numbers(content, joint, Role::Mujoco);
    copy_mimic(content, joint);
    if (!targeted.contains(joint)) {
      add_actuator(content, joint);
    }
  }
}

bool is_contact(std::string_view name) {
  return name == "NewtonCollisionAPI" || name == "newton:contactGap" ||
         name == "newton:contactMargin";
}

bool is_of_newton(std::string_view name, bool but_contacts) {
  return (name.starts_with("Newton") || name.starts_with("newton:")) &&
         !(but_contacts && is_contact(name));
}

layer::Dictionary told_entry(Path robot, std::string_view set) {
  layer::Dictionary entry;
  entry.items.emplace("prim", Value(robot.str()));
  entry.items.emplace("variantSetName", Value(std::string(set)));
  entry.items.emplace("activateOption", Value(std::string(kEnabled)));
  return entry;
}

}  // namespace

std::span<const Runtime> known_runtimes() { return kRuntimes; }

const Layer* enabled_content(const std::vector<OtherVariant>& others, const Runtime& runtime) {
  const auto found = std::find_if(others.begin(), others.end(), [&](const OtherVariant& other) {
    return other.set == runtime.set && other.variant == kEnabled;
  });
  return found == others.end() ? nullptr : &found->content;
}

bool is_runtime_set(std::string_view set) {
  return std::any_of(std::begin(kRuntimes), std::end(kRuntimes),
                     [&](const Runtime& runtime) { return runtime.set == set; });
}

void drop_newton(Layer& content, bool but_contacts) {
  for (const Path& prim : prims_below(content)) {
    if (!content.has(prim) || is_shared_collider(content, prim)) {
      continue;  // it went with one above, or stays
    }
    if (is_of_newton(type_of(content, prim).view(), false)) {
      remove_tree(content, prim);
      continue;
    }
    std::vector<Token> apis = apis_of(content, prim);
    const auto gone =
        std::erase_if(apis, [&](Token api) { return is_of_newton(api.view(), but_contacts); });
    if (gone != 0) {
      set_apis(*content.find(prim), std::move(apis));
    }
    for (const Path& property : properties_of(content, prim)) {
      if (is_of_newton(property.name().view(), but_contacts)) {
        remove_property(content, property);
      }
    }
  }
}

void drop_material_physics(Layer& content) {
  std::unordered_map<Path, bool> has_mesh;  // a prim, as a child
  const auto is_in_instance = [&](Path material) {
    const Path instance = material.parent().parent();
    const auto [known, is_new] = has_mesh.try_emplace(instance, false);
    if (is_new && instance.is_prim()) {
      const std::vector<Path> children = child_prims(content, instance);
      known->second = std::any_of(children.begin(), children.end(),
                                  [&](Path path) { return type_of(content, path) == "Mesh"; });
    }
    return known->second;
  };
  for (const Path& prim : prims_below(content)) {
    if (type_of(content, prim) != "Material" || is_in_instance(prim)) {
      continue;
    }
    const std::vector<Token> before = apis_of(content, prim);
    for (const Path& property : properties_of(content, prim)) {
      if (owner_of_property(property.name(), "Material", before).owner == Role::Physics) {
        remove_property(content, property);
      }
    }
    std::vector<Token> apis = before;
    std::erase_if(apis, [](Token api) { return owner_of_api(api).owner == Role::Physics; });
    set_apis(*content.find(prim), std::move(apis));
  }
}

Layer runtime_content(const Runtime& runtime, Layer content) {
  switch (runtime.role) {
    case Role::Physx:
      complete_physx(content);
      drop_newton(content);
      break;
    case Role::Newton:
      complete_newton(content);
      break;
    default:
      complete_mujoco(content);
      drop_newton(content, true);
  }
  return content;
}

void tell_runtimes(layer::Dictionary& data, Path robot) {
  layer::Dictionary physics;
  for (const Runtime& runtime : kRuntimes) {
    physics.items.emplace(std::string(runtime.set), Value(told_entry(robot, runtime.set)));
  }
  const auto around = [](const char* name, layer::Dictionary inner) {
    layer::Dictionary outer;
    outer.items.emplace(name, Value(std::move(inner)));
    return outer;
  };
  data = layer::merge(
      around("SimReady_Metadata", around("Variants", around("Physics", std::move(physics)))), data);
}

}  // namespace tenon::structure
