// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/stage/stage_data.h"

/// Targets of relationships and connections of attributes as a prim sees them. Internal to
/// tenon/stage.
namespace tenon::stage {

/// Where the sources of prototypes are seen from a prim inside of one: source -> path. The same for
/// all prims of one parent.
using SourceMap = std::vector<std::pair<Path, Path>>;
SourceMap source_map(const StageData& stage, const PrimData& prim, Path proxy_path);
/// `target` under the deepest source that holds it; unchanged when none does.
Path translated(const SourceMap& map, Path target);

/// Targets or connections in the stage's namespace; those inside instances as the prim, prototype
/// or proxy sees them.
std::vector<Path> composed_targets(const StageData& stage, const PrimData& prim, Path proxy_path,
                                   Token name);

/// Places a finding at the target or connection of the property at `path`, as that prim sees it.
void place_target(const StageData& stage, const PrimData& prim, Path path, Path target,
                  Diagnostic& diagnostic);

}  // namespace tenon::stage
