// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/report.h"
#include "tenon/stage/stage.h"

namespace tenon::cli {

/// Everything that any layer says about an object of a stage and what becomes of it:
/// {"prim", "property", "type", "value", "source", "opinions": [{"file", "line", "column", "path",
/// "layer", "sublayerOf", "arcs", "what", "value", "verdict", "why"}]}, strongest first. Without a
/// property: the fields of the prim itself. "verdict" is "wins", "wins at the default time", "wins
/// at times", "combined", "loses", "declares", "ignored" or "not in force"; the fallback of a
/// schema is a row without a file.
Json where_json(const stage::Stage& stage, const stage::Prim& prim, Token property);

/// Appends the opinions of `other`, the same object under other variant selections, that `answer`
/// does not have, as "not in force".
void add_other_variant(Json& answer, const Json& other, const std::string& selection);

std::string where_text(const Json& answer);

}  // namespace tenon::cli
