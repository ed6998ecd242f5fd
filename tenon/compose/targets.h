// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/path.h"
#include "tenon/compose/prim_index.h"

namespace tenon::compose {

class IndexCache;

/// One layer's spec of a property within an index.
struct PropertyOpinion {
  const layer::Layer* layer = nullptr;
  const layer::Spec* spec = nullptr;
  Path path;               ///< of the spec in that layer
  std::uint32_t node = 0;  ///< into PrimIndex::nodes
};

/// Specs of property `name`, strongest first. Those of another kind (attribute, relationship) than
/// the strongest are skipped and diagnosed.
std::vector<PropertyOpinion> property_opinions(const PrimIndex& index, Token name,
                                               Diagnostics* errors);

/// Targets of a relationship or connections of an attribute, in the stage's namespace.
struct TargetList {
  std::vector<Path> paths;
  std::vector<Path> deleted;  ///< removed by list edits
  bool has_opinions = false;
  Diagnostics errors;  ///< invalid-external-target-path and the like
};

/// Combines the list edits of all opinions, each mapped through its node. A class may not target
/// what uses it; such targets are skipped.
TargetList compose_targets(IndexCache& cache, const PrimIndex& index, Token property);

/// The same as a stage has it: targets in other prims that use the class stay, what relocates bring
/// into the one that is composed does not. As OpenUSD's stages; safe to use from several threads.
TargetList compose_stage_targets(const PrimIndex& index, Token property);

/// The item of the strongest opinion that brings a target or connection in, `target` being in the
/// stage's namespace; no layer when none does.
struct TargetOrigin {
  PropertyOpinion opinion;
  StatementPart part;
};
TargetOrigin origin_of_target(const PrimIndex& index, Token property, Path target);

}  // namespace tenon::compose
