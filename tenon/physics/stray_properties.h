// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unordered_map>
#include <vector>

#include "tenon/physics/attribute_values.h"
#include "tenon/physics/contents/definition_memo.h"
#include "tenon/physics/prim_roles.h"

namespace tenon::physics {

/// Finds what looks like physics on prims and is none: properties whose API is not applied (S-2),
/// old and unprefixed names, types of older texts. Remembers which APIs declare a name.
class StrayProperties {
 public:
  /// Whether the prim says with tenon:sensor what it measures, which this walk over its properties
  /// finds on the way.
  bool report_on(const AttributeValues& values, const stage::Prim& prim, const Roles& roles);

 private:
  const std::vector<Token>& apis_of(Token name);
  bool report_ignored(const AttributeValues& values, const stage::Prim& prim, const Roles& roles);

  std::unordered_map<Token, std::vector<Token>> apis_;
  DefinitionMemo concerning_;  // what is not declared and would be something to an API
};

/// API schemas of UsdPhysics and of vendors that declare a property of that name, with the instance
/// that the name belongs to; empty for other names.
std::vector<Token> physics_apis_of(Token name);

}  // namespace tenon::physics
