// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

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

/// `diagnostic` with the place of the property's strongest opinion on what its part is about, else
/// of the prim's.
Diagnostic located_property(const PrimData* prim, Path path, Token name, Diagnostic diagnostic);

/// The strongest site that says what `part` names, else the strongest. `sites` is not empty.
const SpecSite& site_that_says(const std::vector<SpecSite>& sites, const StatementPart& part);

}  // namespace tenon::stage
