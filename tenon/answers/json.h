// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "tenon/base/result.h"

namespace tenon::answers {

/// A value of JSON whose objects keep the order in which their keys were put in.
using Json = nlohmann::ordered_json;

/// The object without keys: an answer that says nothing.
inline Json nothing() { return Json::object(); }

/// Puts a member behind the others, whose keys are known to be different: Json looks for the key
/// among all of them, which takes a square of their number.
inline void append_member(Json& object, std::string key, Json value) {
  object.get_ref<Json::object_t&>().emplace_back(std::move(key), std::move(value));
}

/// The value that a text is; one that is discarded (`is_discarded`) where the text is no JSON. Of
/// keys that an object has twice the last counts.
Json parsed(std::string_view text);
/// The value that a file says, with each key once in its object. Errors: bad(WHY), placed where the
/// text is no JSON.
Result<Json> parsed_file(std::string_view text,
                         const std::function<Error(const std::string&)>& bad);

/// As it is printed: indented, and with an end of line. Bytes that are no UTF-8 are replaced;
/// `only_ascii` writes other characters as escapes.
std::string printed(const Json& json, bool only_ascii = false, int indent = 2);
/// The same without blanks and ends of lines.
std::string on_one_line(const Json& json, bool only_ascii = false);

}  // namespace tenon::answers
