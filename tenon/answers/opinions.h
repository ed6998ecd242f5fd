// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/answers/json.h"
#include "tenon/stage/stage.h"
#include "tenon/stage/values/value_trace.h"

namespace tenon::answers {

/// Every opinion about a property at a time, strongest first: {"file", "line", "column", "path",
/// "what", "value", "used"}; "what" is "default", "timeSamples", "spline", "valueClips" (with
/// "clipSet" and "clip"), "targets" or "declaration".
Json opinions_json(const stage::Stage& stage, const stage::Prim& prim, Token property,
                   stage::Time time);

/// "default", "timeSamples", "spline", "valueClips", "fallback" or "none".
const char* source_name(stage::ValueSource source);
/// The same for an opinion, "declaration" for specs without a value.
std::string what_of(const stage::TracedOpinion& opinion);
/// "clipSet", "clip" and, as "value", both for people, of an opinion of value clips; nothing for
/// others.
void add_clip(const stage::TracedOpinion& opinion, Json& row);

/// The specs of a prim, strongest first: {"file", "line", "column", "path", "specifier"}.
Json specs_json(const stage::Prim& prim);

/// "scene.usda:12:9" of a row of these.
std::string place_text(const Json& row);

/// A value on one line, cut after 120 characters; list edits of paths in words.
std::string short_value_text(const layer::Value& value);

}  // namespace tenon::answers
