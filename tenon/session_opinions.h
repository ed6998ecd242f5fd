// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/layer/layer.h"
#include "tenon/stage/stage.h"

/// Opinions of the command line, written over a session layer in memory.
namespace tenon {

using TextReader =
    std::function<Result<layer::Layer>(std::string_view, std::string, Diagnostics&)>;

/// A copy of `session` (or a new layer when it is null) that selects a variant of a set on the
/// default prim of `root`. ErrorCode::NotFound when `root` names no default prim.
Result<layer::LayerPtr> with_variant(const layer::LayerPtr& session, const layer::Layer& root,
                                     const std::string& set, const std::string& variant);

/// A copy of `session` with "PATH.property=VALUE" written into it. VALUE is in text form of the
/// type that the property has in `stage`; quotes of tokens and strings and the @ of assets may be
/// left out. Errors: Invalid for text that cannot be read, NotFound for properties that the stage
/// has not.
Result<layer::LayerPtr> with_overrides(const layer::LayerPtr& session, const stage::Stage& stage,
                                       const std::vector<std::string>& assignments,
                                       const TextReader& read_text);

}  // namespace tenon
