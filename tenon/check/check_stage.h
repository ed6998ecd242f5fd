// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/check/finding.h"
#include "tenon/physics/read_physics.h"
#include "tenon/stage/stage.h"

namespace tenon::check {

/// Which rules count: ids, or families ("mass" for all mass rules).
struct Selection {
  std::vector<std::string> only;  ///< empty: all
  std::vector<std::string> skip;
  std::vector<std::string> engines{};  ///< rules of portability run for these alone

  /// The rule runs: it is about no engine in particular, or about one of `engines`.
  bool runs(const Rule& rule) const;
  bool takes(std::string_view rule) const;
};

/// Everything that the rules find on a stage, in the order of the rules: what was found while it
/// was opened (`opening`), what the physics reader finds when it reads as `reading` says, then the
/// rules of this folder.
std::vector<Finding> check_stage(const stage::Stage& stage, const std::vector<Diagnostic>& opening,
                                 const Selection& selection,
                                 const physics::ReadOptions& reading = {});

/// "prim property" of what applied APIs of physics declare and the asset authors, sorted.
std::vector<std::string> used_properties(const stage::Stage& stage);

/// Findings of one asset under one variant of its set "Physics".
struct VariantFindings {
  std::string variant;
  std::vector<Finding> findings;
  std::vector<std::string> used{};  ///< used_properties
};

/// One list out of those of all variants: each finding once, with the variants under which it
/// holds; sorted by file, line, column, prim, rule and message.
std::vector<Finding> merge_variants(std::vector<VariantFindings> runs);

/// By file, line and column, then by prim and rule.
void sort_by_place(std::vector<Finding>& findings);

}  // namespace tenon::check
