// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/stage/stage_data.h"
#include "tenon/stage/time.h"
#include "tenon/stage/values/resolve_value.h"

/// Path expressions as values. Internal to tenon/stage.
namespace tenon::stage {

/// `value`, the strongest opinion of an attribute at `time` in the stage's namespace, as the prim
/// (in its prototype, or under an instance at `proxy_path`) sees it: a path expression, or an array
/// of these. Where one alone refers to weaker ones (`%_`), these are put in.
layer::Value compose_expression(const StageData& stage, const PrimData& prim, Path proxy_path,
                                Token name, layer::Value value, Time time,
                                ReadTrace* trace = nullptr);

}  // namespace tenon::stage
