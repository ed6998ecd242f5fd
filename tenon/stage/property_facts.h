// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/stage/spec_site.h"
#include "tenon/stage/stage_data.h"

/// What attributes and relationships have in common. Internal to tenon/stage.
namespace tenon::stage {

bool is_authored_as(const PrimData& prim, Token name, layer::SpecKind kind);
bool any_opinion_is_custom(const PrimData& prim, Token name);
bool has_field(const PrimData& prim, Token name, Token field);
Path property_path(const PrimData& prim, Path proxy_path, Token name);
std::vector<SpecSite> property_sites(const PrimData& prim, Token name);

/// Where the sources of prototypes are seen from a prim inside of one: source -> path.
using SourceMap = std::vector<std::pair<Path, Path>>;
SourceMap source_map(const StageData& stage, const PrimData& prim, Path proxy_path);
/// `target` under the deepest source that holds it; unchanged when none does.
Path translated(const SourceMap& map, Path target);

/// Targets or connections in the stage's namespace; those inside instances as the prim, prototype
/// or proxy sees them.
std::vector<Path> composed_targets(const StageData& stage, const PrimData& prim, Path proxy_path,
                                   Token name);

/// `diagnostic` with the place of the property's strongest opinion on what its part is about, else
/// of the prim's.
Diagnostic located_property(const PrimData* prim, Path path, Token name, Diagnostic diagnostic);

/// The strongest site that says what `part` names, else the strongest. `sites` is not empty.
const SpecSite& site_that_says(const std::vector<SpecSite>& sites, const StatementPart& part);

/// Places a finding at the target or connection of the property at `path`, as that prim sees it.
void place_target(const StageData& stage, const PrimData& prim, Path path, Path target,
                  Diagnostic& diagnostic);

}  // namespace tenon::stage
