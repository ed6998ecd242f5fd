// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/schema/declaring_apis.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_map>

#include "tenon/schema/registry.h"

namespace tenon::schema {
namespace {

constexpr std::string_view kInstance = "__INSTANCE_NAME__";

/// A property of a multiple-apply schema: what stands before and behind the name of the instance.
struct InstancedName {
  Token api;
  std::string_view before;
  std::string_view behind;

  /// The instance that `name` belongs to; empty when it is not such a name.
  std::string_view instance_in(std::string_view name) const {
    const bool fits = name.size() > before.size() + behind.size() && name.starts_with(before) &&
                      name.ends_with(behind);
    return fits ? name.substr(before.size(), name.size() - before.size() - behind.size())
                : std::string_view();
  }
};

struct Declarations {
  std::unordered_map<Token, std::vector<Token>> apis;
  std::unordered_map<Token, std::vector<Token>> types;
  std::vector<InstancedName> instanced;

  void add(const Schema& schema) {
    for (const PropertyDefinition& property : schema.properties) {
      const std::string_view name = property.name.view();
      const std::size_t at = name.find(kInstance);
      if (at != std::string_view::npos) {
        instanced.push_back({schema.name, name.substr(0, at), name.substr(at + kInstance.size())});
      } else if (schema.is_applied_api()) {
        apis[property.name].push_back(schema.name);
      } else if (!inherits(schema, property.name)) {
        types[property.name].push_back(schema.name);
      }
    }
  }

  static bool inherits(const Schema& schema, Token property) {
    const Schema* base = Registry::instance().find(schema.base);
    return base != nullptr &&
           std::any_of(base->properties.begin(), base->properties.end(),
                       [&](const PropertyDefinition& p) { return p.name == property; });
  }
};

const Declarations& declarations() {
  static const Declarations all = [] {
    Declarations found;
    for (const Schema* schema : Registry::instance().schemas()) {
      found.add(*schema);
    }
    return found;
  }();
  return all;
}

}  // namespace

std::vector<Token> declaring_apis(Token property) {
  std::vector<Token> found;
  if (const auto it = declarations().apis.find(property); it != declarations().apis.end()) {
    found = it->second;
  }
  for (const InstancedName& name : declarations().instanced) {
    const std::string_view instance = name.instance_in(property.view());
    if (!instance.empty()) {
      found.emplace_back(name.api.str() + ":" + std::string(instance));
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<Token> declaring_types(Token property) {
  const auto it = declarations().types.find(property);
  return it == declarations().types.end() ? std::vector<Token>() : it->second;
}

}  // namespace tenon::schema
