// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/base/token.h"
#include "tenon/layer/expressions/path_expression.h"
#include "tenon/stage/collections/path_matcher.h"
#include "tenon/stage/prim.h"
#include "tenon/stage/stage.h"

namespace tenon::stage {

/// Membership of one CollectionAPI instance, as OpenUSD's UsdCollectionMembershipQuery decides it:
/// by rules when the collection includes or excludes anything, else by its membership expression.
class Collection {
 public:
  /// What an included path brings with it; "expandPrims" is the fallback.
  enum class Rule : unsigned char { Exclude, ExplicitOnly, ExpandPrims, ExpandPrimsAndProperties };
  using Rules = std::unordered_map<Path, Rule>;

  /// The collection `prim`.collection:`name`; an empty one when there is none.
  /// `most`: work of reading (see `work`) after which the rest of it is not found.
  static Collection read(const Prim& prim, Token name, std::size_t most = SIZE_MAX);

  bool contains(Path path) const;
  /// All that belongs, sorted: prims that a stage traversal meets by default (active, loaded,
  /// defined, not abstract, not inside of instances) and their properties.
  std::vector<Path> members(const Stage& stage) const;

  /// Rules of this and of included collections; the one of the nearest path at or above counts.
  const Rules& rules() const { return rules_; }
  /// A limit was met (kCollectionVisits, kCollectionItems, kMatchWork, `most`): some of what
  /// belongs is not found. Also true once a question to `contains` took too much.
  bool is_cut() const { return is_cut_ || matcher_.is_exhausted(); }
  /// Targets that were read for it, each collection on the way for 20 more.
  std::size_t work() const { return work_; }
  /// Names compared so far for the membership expression, of which kMatchWork are allowed.
  std::size_t match_work() const { return matcher_.work(); }

 private:
  bool included_by_rules(Path path) const;
  void add_by_rule(const Stage& stage, Path path, Rule rule, std::unordered_set<Path>& visited,
                   std::vector<Path>& members) const;
  void add_by_expression(const Stage& stage, std::vector<Path>& members) const;

  Rules rules_;
  bool is_cut_ = false;
  std::size_t work_ = 0;
  Rule top_rule_ = Rule::ExpandPrims;
  PathMatcher matcher_;
};

/// What the membership expression of `prim`.collection:`name` says with the references to other
/// collections replaced; a reference that leads nowhere or back matches nothing.
layer::PathExpressionTree complete_membership_expression(const Prim& prim, Token name);

}  // namespace tenon::stage
