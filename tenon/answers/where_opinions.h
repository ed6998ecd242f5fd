// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "tenon/answers/json.h"
#include "tenon/base/result.h"
#include "tenon/stage/stage.h"

namespace tenon::answers {

/// Everything that any layer says about an object of a stage and what becomes of it:
/// {"prim", "property", "type", "value", "source", "opinions": [{"file", "line", "column", "path",
/// "sublayerOf", "arcs", "what", "value", "verdict", "why"}]}, strongest first. Without a
/// property: the fields of the prim itself. "verdict" is "wins", "wins at the default time", "wins
/// at times", "combined", "loses", "declares", "ignored" or "not in force"; the fallback of a
/// schema is a row without a file; a row of value clips has "clipSet" and "clip", the clip in force
/// at `time`. What counts "at times" is judged there, else at time 0; with a time also "time" and
/// "valueAtTime".
Json where_json(const stage::Stage& stage, const stage::Prim& prim, Token property,
                std::optional<double> time);

/// Errors: NotFound, for a name that neither a schema nor a layer knows as a property of the prim.
Result<void> check_property(const stage::Prim& prim, Token property);

/// Appends the opinions of `other`, the same object under other variant selections, that `answer`
/// does not have, as "not in force".
void add_other_variant(Json& answer, const Json& other, const std::string& selection);

}  // namespace tenon::answers
