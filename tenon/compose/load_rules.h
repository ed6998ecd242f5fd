// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/path.h"
#include "tenon/compose/cache/index_cache.h"

namespace tenon::compose {

enum class LoadRule : unsigned char { All, Only, None };

/// The rule in force at a prim; Only when payloads of the prim itself are included but not, without
/// rules of their own, those below it.
LoadRule load_rule(const ComposeOptions& options, Path prim_path);

/// The rules as they look from a prim down: whether two prims are told apart by them.
std::string load_rules_below(const ComposeOptions& options, Path prim_path);

/// The payloads of a stage prim are included: by default or because of itself, an ancestor or, as
/// they must be there for it, a descendant that is asked for.
bool is_loaded(const ComposeOptions& options, Path prim_path);

}  // namespace tenon::compose
