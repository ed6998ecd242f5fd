// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/stage/values/resolve_value.h"

/// Edits of arrays as values: a stronger edit is applied to what weaker opinions give. Internal to
/// tenon/stage. As OpenUSD 26.11, with these differences: before the first sample the first value
/// holds and blocks hold until the next sample (OpenUSD extrapolates and gives nan, or skips the
/// block), and arrays of assets and of path expressions are edited, too.
namespace tenon::stage {

ValueSources value_sources(const PrimData& prim, Token name, Asked asked);

/// Whether the value or one of the samples is an edit.
bool may_edit(const ResolvedValue& source);

/// The value at `time`. Each source holds until its next sample; what they make together is
/// interpolated between the samples of all of them that are no blocks.
layer::Value compose_array_edits(const StageData& stage, const PrimData& prim, Token name,
                                 Time time, AssetForm form, ReadTrace* trace = nullptr);

/// The samples that change the value, in stage time, ascending: those of a weaker source count
/// while all stronger ones are edits.
std::vector<double> edited_times(const StageData& stage, const PrimData& prim,
                                 const ValueSources& sources);

}  // namespace tenon::stage
