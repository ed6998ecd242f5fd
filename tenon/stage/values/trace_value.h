// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/stage/stage_data.h"
#include "tenon/stage/values/value_trace.h"

/// Internal to tenon/stage.
namespace tenon::stage {

/// Reads a value as `read_attribute` does and says what became of every opinion about it.
ValueTrace trace_value(const StageData& stage, const PrimData& prim, Path proxy_path, Token name,
                       Time time);

}  // namespace tenon::stage
