// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/report.h"
#include "tenon/stage/prim.h"

namespace tenon::cli {

/// Every opinion about a property, strongest first: {"file", "line", "column", "path", "what",
/// "value", "used"}; "what" is "default", "timeSamples", "spline", "targets" or "declaration".
Json opinions_json(const stage::Prim& prim, Token property);

/// The specs of a prim, strongest first: {"file", "line", "column", "path", "specifier"}.
Json specs_json(const stage::Prim& prim);

/// "scene.usda:12:9" of a row of these.
std::string place_text(const Json& row);

/// A value on one line, long ones cut; list edits of paths in words.
std::string short_value_text(const layer::Value& value);

/// The rows of `opinions_json` for people, a line each.
std::string opinions_text(const Json& opinions, const std::string& indent);

}  // namespace tenon::cli
