// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/base/token.h"
#include "tenon/stage/prim.h"
#include "tenon/stage/stage.h"

namespace tenon::stage {

/// Membership of one CollectionAPI instance, as rules: the rule of the nearest path at or above a
/// prim decides. Nested collections are followed.
class Collection {
 public:
  /// The collection `prim`.collection:`name`; an empty one when the API is not applied there.
  static Collection read(const Prim& prim, Token name);

  bool contains(Path path) const;
  /// All prims (and properties, under expandPrimsAndProperties) that belong, sorted.
  std::vector<Path> members(const Stage& stage) const;

 private:
  friend class CollectionReader;
  enum class Rule : unsigned char { Exclude, ExplicitOnly, ExpandPrims, ExpandPrimsAndProperties };

  std::unordered_map<Path, Rule> rules_;
  std::string expression_;  // used when there are no rules
  Path anchor_;             // of relative patterns in the expression
};

/// The path expression matches `path`: patterns such as `/World/a*`, `//Name`, `/A//`, joined by
/// '+', '|', '&', '-', ' ' and '~'. Predicates and references to collections match nothing.
bool expression_matches(const std::string& expression, Path anchor, Path path);

}  // namespace tenon::stage
