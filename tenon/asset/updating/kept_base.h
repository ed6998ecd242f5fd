// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/diff/merge/merge_layers.h"
#include "tenon/layer/layer.h"

/// What later updates compare with after a conflict in which the edit stayed: the old value, so
/// that the source's change can still be taken.
namespace tenon {

/// `source`, but as `base` at the conflicts and at the prims in `whole`, with the prims around
/// them.
layer::Layer kept_base(const layer::Layer& base, const layer::Layer& source,
                       const std::vector<diff::MergeConflict>& conflicts,
                       const std::set<Path>& whole);

/// Tells one conflict from others: its place and what the source says there.
std::uint64_t conflict_digest(const diff::MergeConflict& conflict);

}  // namespace tenon
