// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/physics/readings.h"
#include "tenon/stage/stage.h"

namespace tenon {

/// Where a number comes from, as JSON text: what `tenon explain --json` says of "/prim" (what it is
/// to the engines), of "/prim.property" (every opinion about it), or with `other` of two prims
/// (whether they collide, and why not); docs/outputs.md lists the keys. ErrorCode::NotFound where
/// the stage has nothing there.
Result<std::string> explain(const stage::Stage& stage, const std::string& object,
                            const std::string& other, const physics::Readings& readings,
                            Diagnostics& diagnostics);

}  // namespace tenon
