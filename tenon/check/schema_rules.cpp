// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Names that no schema knows: types, applied APIs, properties.
#include <algorithm>
#include <array>
#include <string_view>

#include "tenon/base/text/nearest_name.h"
#include "tenon/check/subject.h"
#include "tenon/physics/attribute_values.h"
#include "tenon/physics/stray_properties.h"
#include "tenon/schema/declaring_apis.h"
#include "tenon/schema/registry.h"

namespace tenon::check {
namespace {

/// Names of older texts and what they became.
constexpr std::pair<std::string_view, std::string_view> kOldApis[] = {
    {"PhysicsArticulationAPI", "PhysicsArticulationRootAPI"},
    {"PhysicsFilteringPairsAPI", "PhysicsFilteredPairsAPI"},
    {"FilteringPairsAPI", "PhysicsFilteredPairsAPI"},
    {"PhysicsCollisionMeshAPI", "PhysicsMeshCollisionAPI"},
    {"PhysicsAPI", "PhysicsRigidBodyAPI"}};

/// Names that others have for properties of the schema.
constexpr std::pair<std::string_view, std::string_view> kOtherNames[] = {
    {"physics:linearVelocity", "physics:velocity"},
    {"physics:gravity", "physics:gravityMagnitude"},
    {"physics:friction", "physics:dynamicFriction"},
    {"physics:inertia", "physics:diagonalInertia"}};

constexpr std::array<std::string_view, 6> kPhysicsSpaces{
    "physics:", "drive:", "limit:", "physx", "newton:", "mjc:"};

bool is_physics_name(std::string_view name) {
  return std::any_of(kPhysicsSpaces.begin(), kPhysicsSpaces.end(),
                     [&](std::string_view space) { return name.starts_with(space); });
}

/// Names that typed and applied schemas of physics declare, with those of shapes and transforms.
std::vector<std::string_view> property_names() {
  std::vector<std::string_view> names;
  for (const schema::Schema* schema : schema::Registry::instance().schemas()) {
    for (const schema::PropertyDefinition& property : schema->properties) {
      if (is_physics_name(property.name.view())) {
        names.push_back(property.name.view());
      }
    }
  }
  return names;
}

std::string advice(std::string_view nearest, const char* otherwise) {
  return nearest.empty() ? otherwise : "write " + std::string(nearest);
}

bool is_custom(const stage::Prim& prim, Token name) {
  return prim.is_relationship(name) ? prim.relationship(name).is_custom()
                                    : prim.attribute(name).is_custom();
}

/// "PhysicsPrismaticJoint and PhysicsRevoluteJoint", of types of physics that declare the name.
std::string declaring_types_text(Token name) {
  std::string text;
  for (const Token type : schema::declaring_types(name)) {
    const bool physics =
        type.view().starts_with("Physics") || schema::Registry::instance().is_vendor(type);
    text += physics ? (text.empty() ? "" : " and ") + type.str() : "";
  }
  return text;
}

/// Unknown types have a finding of their own.
bool is_known_type(const stage::Prim& prim) {
  return prim.type_name().empty() || prim.definition()->schema() != nullptr;
}

/// Among the names that the prim's applied instances declare: those of "drive:angular".
std::string_view nearest_of_instances(const stage::Prim& prim, Token name) {
  const std::string_view space = name.view().substr(0, name.view().find(':') + 1);
  std::vector<std::string_view> names;
  for (const Token declared : prim.definition()->property_names(true)) {
    if (declared.view().starts_with(space)) {
      names.push_back(declared.view());
    }
  }
  return nearest_name(name.view(), names);
}

bool is_authored_as_attribute(const stage::Prim& prim, Token name) {
  const std::vector<stage::SpecSite> sites = prim.relationship(name).spec_stack();
  return std::any_of(sites.begin(), sites.end(), [](const stage::SpecSite& site) {
    return site.spec->kind == layer::SpecKind::Attribute;
  });
}

/// Names of all API schemas, or of all others.
std::vector<std::string_view> schema_names(bool apis) {
  std::vector<std::string_view> names;
  for (const schema::Schema* schema : schema::Registry::instance().schemas()) {
    if (schema->is_applied_api() == apis) {
      names.push_back(schema->name.view());
    }
  }
  return names;
}

}  // namespace

void check_unknown_type(const Subject& subject, Reporter& report) {
  NearestNames nearest_names([] { return schema_names(false); });
  for (const stage::Prim& prim : subject.prims) {
    const Token type = prim.type_name();
    if (type.empty() || schema::Registry::instance().find(type) != nullptr ||
        subject.has_finding("joint.unknown-type", prim.path().str())) {
      continue;
    }
    const std::string_view nearest = nearest_names.find(type);
    if (!nearest.empty()) {
      report.at(prim, "there is no type \"" + type.str() + "\"; the prim counts as untyped",
                advice(nearest, ""), physics::type_part());
    }
  }
}

void check_unknown_api(const Subject& subject, Reporter& report) {
  NearestNames nearest_names([] { return schema_names(true); });
  for (const stage::Prim& prim : subject.prims) {
    for (const Token applied : prim.authored_api_schemas()) {
      const Token name = schema::split_api_name(applied).first;
      if (schema::Registry::instance().find(name) != nullptr) {
        continue;
      }
      std::string_view nearest = nearest_names.find(name);
      for (const auto& [old_name, new_name] : kOldApis) {
        nearest = name == old_name ? new_name : nearest;
      }
      if (!nearest.empty() || name.view().starts_with("Physics")) {
        report.at(prim, "there is no API schema \"" + name.str() + "\"; it is ignored",
                  advice(nearest, "apply a schema that exists"), physics::api_part(applied.str()));
      }
    }
  }
}

void check_unknown_attribute(const Subject& subject, Reporter& report) {
  constexpr std::size_t kMaxSearches = 10000;
  std::size_t instance_searches = 0;
  NearestNames nearest_names(property_names);
  for (const stage::Prim& prim : subject.prims) {
    for (const Token name : prim.authored_property_names()) {
      if (!is_physics_name(name.view()) || prim.definition()->find(name) != nullptr ||
          is_custom(prim, name) || !physics::physics_apis_of(name).empty() ||
          subject.is_reported(prim.path().str(), name.str())) {
        continue;  // attribute.api-missing is about those of APIs
      }
      if (const std::string types = declaring_types_text(name); !types.empty()) {
        if (is_known_type(prim)) {
          report.at(prim, name,
                    name.str() + " is a property of " + types +
                        ", which the prim is not; it is "
                        "ignored",
                    "remove it, or give the prim the type that declares it");
        }
        continue;
      }
      std::string_view nearest = nearest_names.find(name);
      if (nearest.empty() && instance_searches < kMaxSearches) {
        ++instance_searches;
        nearest = nearest_of_instances(prim, name);
      }
      for (const auto& [other, meant] : kOtherNames) {
        nearest = name == other ? meant : nearest;
      }
      const std::string_view space = name.view().substr(0, name.view().find(':'));
      if (!nearest.empty() || space == "physics") {
        report.at(prim, name, "no schema of the prim declares " + name.str() + "; it is ignored",
                  advice(nearest, "apply the API that declares it, or remove it"));
      }
    }
  }
}

// S-3: OpenUSD ignores attributes where the schema has a relationship.
void check_property_kind(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    for (const Token name : prim.unordered_property_names()) {
      const schema::PropertyDefinition* declared =
          is_physics_name(name.view()) ? prim.definition()->find(name) : nullptr;
      if (declared != nullptr && declared->is_relationship &&
          is_authored_as_attribute(prim, name)) {
        report.at(prim, name,
                  name.str() +
                      " is declared as an attribute, the schema says a relationship; it "
                      "is taken as unauthored",
                  "declare it as a relationship: rel " + name.str());
      }
    }
  }
}

//
void check_moved_input(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    for (const Token name : prim.authored_property_names()) {
      const Token input("inputs:" + name.str());
      if (prim.definition()->find(name) == nullptr && prim.definition()->find(input) != nullptr) {
        report.at(prim, name, name.str() + " is not declared; the schema's name is " + input.str(),
                  "write " + input.str());
      }
    }
  }
}

}  // namespace tenon::check
