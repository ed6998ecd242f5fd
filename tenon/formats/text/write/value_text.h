// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "tenon/base/result.h"
#include "tenon/base/text/quoted_text.h"
#include "tenon/layer/type_names.h"
#include "tenon/layer/value.h"

namespace tenon::formats {

/// A value as text layers print it: `(1, 2, 3)`, `"name"`, `@file.usda@`, `[1, 2]`, `None`.
/// Dictionaries are on one line: `{ int a = 1; string b = "x" }`. Deferred arrays are decoded.
std::string value_text(const layer::Value& value);

/// Reads one value of the given type from all of `text`; "None" and "AnimationBlock" block.
Result<layer::Value> parse_value(std::string_view text, const layer::TypeName& type);

namespace text {

/// `quoted_text(text)` at the end of `out`.
void append_quoted(std::string& out, std::string_view text);
/// Appends what `value_text` gives.
void append_value_text(std::string& out, const layer::Value& value);
/// The minor version that a text layer with the value has. For edits of arrays OpenUSD 26.11 raises
/// it only where the elements are texts.
int minor_version_of(const layer::Value& value);

}  // namespace text
}  // namespace tenon::formats
