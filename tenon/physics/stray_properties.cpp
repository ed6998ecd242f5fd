// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The tables of schemas say which API a property belongs to. A property that neither the type of
// its prim nor an applied API declares, and that some API of physics does, is ignored by all
// readers. Most names are declared, or are outside of the namespaces of physics, so the tables are
// asked for few of them.
#include "tenon/physics/stray_properties.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "tenon/base/text/comma_list.h"
#include "tenon/physics/physics_tokens.h"
#include "tenon/schema/declaring_apis.h"
#include "tenon/schema/registry.h"

namespace tenon::physics {
namespace {

/// What names of properties begin with that APIs of physics declare.
constexpr std::array<std::string_view, 10> kPhysicsBeginnings{
    "deformablePose:", "drive:",       "isaac:",   "limit:", "mjc:",
    "newton:",         "omniphysics:", "physics:", "physx",  "state:"};

bool begins_as_physics(Token name) {
  return std::any_of(kPhysicsBeginnings.begin(), kPhysicsBeginnings.end(),
                     [&](std::string_view begins) { return name.view().starts_with(begins); });
}

/// Names without the prefix that the schema wants.
const std::vector<Token>& unprefixed(const Roles& roles) {
  static const std::vector<Token> material{"staticFriction", "dynamicFriction", "restitution",
                                           "density"};
  static const std::vector<Token> body{"velocity", "angularVelocity", "mass"};
  static const std::vector<Token> none;
  return roles.has(Api::Material) ? material : roles.has(Api::RigidBody) ? body : none;
}

/// The word in the names of APIs that are made for such prims.
std::string_view word_of(const stage::Prim& prim, const Roles& roles) {
  if (is_joint(roles.kind)) {
    return "Joint";
  }
  return prim.is_a("Material") ? "Material" : roles.kind >= PrimKind::Cube ? "Collision" : "Body";
}

/// How well an API fits a prim of that kind: several declare some names.
int fit_of(Token api, std::string_view word) {
  const std::string_view name = api.view();
  if (name.find(word) != std::string_view::npos) {
    return 2;
  }
  const auto is_of_others = [&](std::string_view other) {
    return name.find(other) != std::string_view::npos;
  };
  return is_of_others("Joint") || is_of_others("Material") || is_of_others("Collision") ? 0 : 1;
}

/// The property has an opinion: a value, at some time, or a target.
bool is_said(const stage::Prim& prim, Token name) {
  return prim.is_relationship(name) ? !prim.relationship(name).targets().empty()
                                    : prim.attribute(name).has_authored_value();
}

/// The approximation of a mesh has a rule of its own (S-62).
bool has_its_own_rule(Token name, const Roles& roles) {
  return name == physics_tokens().approximation && roles.has(Api::Collision) &&
         roles.kind == PrimKind::Mesh;
}

}  // namespace

bool names_physics(Token property) {
  return property == physics_tokens().sensor || begins_as_physics(property);
}

std::vector<Token> physics_apis_of(Token name) {
  std::vector<Token> apis =
      begins_as_physics(name) ? schema::declaring_apis(name) : std::vector<Token>();
  std::erase_if(apis, [](Token api) {
    return !api.view().starts_with("Physics") &&
           !schema::Registry::instance().is_vendor(schema::split_api_name(api).first);
  });
  return apis;
}

const std::vector<Token>& StrayProperties::apis_of(Token name) {
  const auto known = apis_.find(name);
  return known != apis_.end() ? known->second
                              : apis_.emplace(name, physics_apis_of(name)).first->second;
}

// S-2
bool StrayProperties::report_ignored(const AttributeValues& values, const stage::Prim& prim,
                                     const Roles& roles) {
  const std::vector<Token>& authored = prim.unordered_property_names();
  const auto concerns = [](const stage::Prim& at, Token name) {
    return at.definition()->find(name) == nullptr && names_physics(name);
  };
  if (std::none_of(authored.begin(), authored.end(),
                   [&](Token name) { return concerning_.ask(prim, name, concerns); })) {
    return false;
  }
  std::vector<std::pair<Token, std::vector<Token>>> ignored;  // API, names
  bool marks_sensor = false;
  for (const Token name : prim.authored_property_names()) {
    if (prim.definition()->find(name) != nullptr) {
      continue;
    }
    marks_sensor = marks_sensor || name == physics_tokens().sensor;
    const std::vector<Token>& apis = apis_of(name);
    if (apis.empty() || has_its_own_rule(name, roles) || !is_said(prim, name)) {
      continue;
    }
    const std::string_view word = word_of(prim, roles);
    const Token api = *std::max_element(apis.begin(), apis.end(), [&](Token a, Token b) {
      return fit_of(a, word) < fit_of(b, word);
    });
    auto row = std::find_if(ignored.begin(), ignored.end(),
                            [&](const auto& known) { return known.first == api; });
    row = row == ignored.end() ? ignored.insert(row, {api, {}}) : row;
    row->second.push_back(name);
  }
  for (const auto& [api, names] : ignored) {
    const std::string list = comma_list(names, &Token::str);
    values.report(
        prim, names.front(), Severity::Warning, "attribute.api-missing",
        list + (names.size() == 1 ? " is" : " are") + " ignored: " + api.str() + " is not applied",
        "apply " + api.str());
  }
  return marks_sensor;
}

bool StrayProperties::report_on(const AttributeValues& values, const stage::Prim& prim,
                                const Roles& roles) {
  const bool marks_sensor = values.stage_names_apis() && report_ignored(values, prim, roles);
  for (const Token name : unprefixed(roles)) {
    if (prim.has_property(name)) {
      values.report(prim, name, Severity::Warning, "attribute.unprefixed",
                    name.str() + " is ignored: the schema's name is physics:" + name.str(),
                    "write physics:" + name.str());
    }
  }
  if (!roles.meant_type.empty()) {
    report(values.diagnostics(), prim, Severity::Warning, "joint.unknown-type",
           "there is no type \"" + prim.type_name().str() + "\"; the joint is skipped",
           "write " + roles.meant_type.str(), type_part());
  }
  return marks_sensor;
}

}  // namespace tenon::physics
