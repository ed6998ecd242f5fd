// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tenon/layer/value.h"
#include "tenon/stage/sources/opinion_sources.h"
#include "tenon/stage/stage.h"
#include "tenon/stage/values/opinion_role.h"

namespace tenon::stage {

/// One opinion about a field that is no value of an attribute: metadata, arcs, targets.
struct TracedField {
  Token field;
  OpinionSource source;
  const layer::Value* value = nullptr;  ///< as authored; nullptr of specs without the field
  OpinionRole role = OpinionRole::Loses;
  OpinionReason reason = OpinionReason::None;
  std::optional<std::size_t> decided_by;  ///< of the losing: which row is the cause
};

/// Every opinion about every field of the prim at `prim` (instance proxies included), except lists
/// of children: spec by spec, strongest first. Arcs combine within each layer stack.
std::vector<TracedField> trace_fields(const Stage& stage, Path prim);

/// The same for the targets of a relationship or the connections of an attribute, whichever the
/// strongest spec is. Specs without any are listed, too: they declare.
std::vector<TracedField> trace_targets(const Stage& stage, Path prim, Token property);

}  // namespace tenon::stage
