// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/answers/json.h"
#include "tenon/stage/stage.h"

namespace tenon::answers {

/// [{"prim", "set", "selection", "options"}]: a row for every variant set of every prim, depth
/// first. With `only`, of the prim at that path alone; empty: of all.
Json variants_json(const stage::Stage& stage, const std::string& only);

/// {"variants": those rows}.
Json variant_list_json(const stage::Stage& stage, const std::string& only);

/// Appends the rows of one prim.
void add_variants(const stage::Prim& prim, Json& variants);

}  // namespace tenon::answers
