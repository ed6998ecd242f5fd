// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/layer/dictionary.h"

namespace tenon::formats::text {

enum class Lines : unsigned char { One, Many };

/// `{ type name = value ... }`; with Many one entry per line, closed at `indent` steps, and an end
/// of line at the end.
void append_dictionary(std::string& out, const layer::Dictionary& dictionary, std::size_t indent,
                       Lines lines);

/// Values that only fields have: dictionaries, enums, unregistered values, list ops, paths.
void append_field_text(std::string& out, const layer::Value& value);

}  // namespace tenon::formats::text
