// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/layer/layer.h"
#include "tenon/stage/stage.h"

/// Opinions of the command line, written over a session layer in memory.
namespace tenon {

/// A copy of `session` (or a new layer when it is null) that selects a variant of a set on the
/// default prim of `root`. ErrorCode::NotFound when `root` names no default prim.
Result<layer::LayerPtr> with_variant(const layer::LayerPtr& session, const layer::Layer& root,
                                     const std::string& set, const std::string& variant);

/// The same on any prim of the stage.
layer::LayerPtr with_variant(const layer::LayerPtr& session, Path prim, const std::string& set,
                             const std::string& variant);

/// A copy of `session` with "PATH.property=VALUE" written into it, as property_value.h reads it.
/// Errors: those of that, and NotFound (edit.no-prim).
Result<layer::LayerPtr> with_overrides(const layer::LayerPtr& session, const stage::Stage& stage,
                                       const std::vector<std::string>& assignments);

}  // namespace tenon
