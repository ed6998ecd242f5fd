// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Names that no schema knows: types, applied APIs, properties.
#include <algorithm>
#include <array>
#include <string_view>

#include "tenon/check/nearest_name.h"
#include "tenon/check/subject.h"
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

constexpr std::array<std::string_view, 6> kPhysicsSpaces{
    "physics:", "drive:", "limit:", "physx", "newton:", "mjc:"};

bool is_physics_name(std::string_view name) {
  return std::any_of(kPhysicsSpaces.begin(), kPhysicsSpaces.end(),
                     [&](std::string_view space) { return name.starts_with(space); });
}

/// Declared names of the prim, and of the physics APIs that could be applied.
std::vector<std::string_view> candidates(const stage::Prim& prim) {
  std::vector<std::string_view> names;
  for (const Token name : prim.definition()->property_names(true)) {
    names.push_back(name.view());
  }
  for (const schema::Schema* schema : schema::Registry::instance().schemas()) {
    if (schema->name.view().starts_with("Physics")) {
      for (const schema::PropertyDefinition& property : schema->properties) {
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

/// A property of another API of physics: attribute.api-missing is about those.
bool is_known_elsewhere(std::string_view name) {
  for (const schema::Schema* schema : schema::Registry::instance().schemas()) {
    for (const schema::PropertyDefinition& property : schema->properties) {
      if (property.name == name) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

void check_unknown_type(const Subject& subject, Reporter& report) {
  std::vector<std::string_view> names;
  for (const schema::Schema* schema : schema::Registry::instance().schemas()) {
    if (!schema->is_applied_api()) {
      names.push_back(schema->name.view());
    }
  }
  for (const stage::Prim& prim : subject.prims) {
    const Token type = prim.type_name();
    if (type.empty() || schema::Registry::instance().find(type) != nullptr ||
        subject.has_finding("joint.unknown-type", prim.path().str())) {
      continue;
    }
    const std::string_view nearest = nearest_name(type.view(), names);
    if (!nearest.empty()) {
      report.at(prim, "there is no type \"" + type.str() + "\"; the prim counts as untyped",
                advice(nearest, ""));
    }
  }
}

void check_unknown_api(const Subject& subject, Reporter& report) {
  std::vector<std::string_view> names;
  for (const schema::Schema* schema : schema::Registry::instance().schemas()) {
    if (schema->is_applied_api()) {
      names.push_back(schema->name.view());
    }
  }
  for (const stage::Prim& prim : subject.prims) {
    for (const Token applied : prim.authored_api_schemas()) {
      const Token name = schema::split_api_name(applied).first;
      if (schema::Registry::instance().find(name) != nullptr) {
        continue;
      }
      std::string_view nearest = nearest_name(name.view(), names);
      for (const auto& [old_name, new_name] : kOldApis) {
        nearest = name == old_name ? new_name : nearest;
      }
      if (!nearest.empty() || name.view().starts_with("Physics")) {
        report.at(prim, "there is no API schema \"" + name.str() + "\"; it is ignored",
                  advice(nearest, "apply a schema that exists"));
      }
    }
  }
}

void check_unknown_attribute(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    for (const Token name : prim.authored_property_names()) {
      if (!is_physics_name(name.view()) || prim.definition()->find(name) != nullptr ||
          is_custom(prim, name) || is_known_elsewhere(name.view()) ||
          subject.is_reported(prim.path().str(), name.str())) {
        continue;
      }
      const std::string_view nearest = nearest_name(name.view(), candidates(prim));
      const std::string_view space = name.view().substr(0, name.view().find(':'));
      if (!nearest.empty() || space == "physics") {
        report.at(prim, name, "no schema of the prim declares " + name.str() + "; it is ignored",
                  advice(nearest, "apply the API that declares it, or remove it"));
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
