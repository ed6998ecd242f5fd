// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/authoring/kinds.h"

#include <set>

#include <gtest/gtest.h>

#include "tenon/base/token.h"
#include "tenon/schema/registry.h"

namespace tenon {
namespace {

Token token(std::string_view text) { return Token(std::string(text)); }

/// "PhysicsDriveAPI:*" and "drive:*:physics:damping" with an instance.
Token instanced(std::string_view text) {
  std::string name(text);
  const std::size_t star = name.find('*');
  return Token(star == std::string::npos ? name : name.replace(star, 1, "rotX"));
}

std::vector<Token> schemas_of(const AuthoringKind& kind) {
  std::vector<Token> apis;
  for (const std::string_view api : kind.apis) {
    apis.push_back(instanced(api));
  }
  return apis;
}

TEST(Kinds, TypesAndSchemasAreThoseOfTheTables) {
  const schema::Registry& registry = schema::Registry::instance();
  for (const AuthoringKind& kind : authoring_kinds()) {
    if (kind.makes_prim()) {
      const schema::Schema* type = registry.find(token(kind.type));
      ASSERT_NE(type, nullptr) << kind.name;
      EXPECT_EQ(type->kind, schema::SchemaKind::ConcreteTyped) << kind.name;
    }
    for (const Token api : schemas_of(kind)) {
      const schema::Schema* schema = registry.find(schema::split_api_name(api).first);
      ASSERT_NE(schema, nullptr) << kind.name << " " << api.str();
      EXPECT_TRUE(schema->is_applied_api()) << api.str();
    }
    for (const std::string_view api : kind.also_ends) {
      EXPECT_NE(registry.find(token(api)), nullptr) << api;
    }
    EXPECT_TRUE(kind.on.empty() || registry.find(token(kind.on)) != nullptr) << kind.on;
  }
}

TEST(Kinds, PropertiesAreDeclaredBySchemasOfTheKind) {
  for (const AuthoringKind& kind : authoring_kinds()) {
    const schema::PrimDefinition definition(token(kind.type), schemas_of(kind));
    for (const KindOption& option : kind.options) {
      const bool binding = option.property == "material:binding:physics";
      if (!option.property.empty() && !binding) {
        EXPECT_NE(definition.find(instanced(option.property)), nullptr)
            << kind.name << " --" << option.name << " " << option.property;
      }
    }
  }
}

TEST(Kinds, NamesAreUniqueAndEveryOptionIsDescribedAndTaken) {
  std::set<std::string_view> names;
  std::set<std::string_view> options;
  for (const AuthoringOption& option : authoring_options()) {
    EXPECT_TRUE(options.insert(option.name).second) << option.name;
    bool taken = false;
    for (const AuthoringKind& kind : authoring_kinds()) {
      taken = taken || kind.takes(option.name);
    }
    EXPECT_TRUE(taken) << option.name;
  }
  for (const AuthoringKind& kind : authoring_kinds()) {
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
    EXPECT_EQ(find_kind(kind.name), &kind);
    for (const KindOption& option : kind.options) {
      EXPECT_TRUE(options.contains(option.name)) << kind.name << " --" << option.name;
    }
    for (const std::string_view need : kind.needs) {
      EXPECT_TRUE(kind.takes(need)) << kind.name << " --" << need;
    }
  }
}

}  // namespace
}  // namespace tenon
