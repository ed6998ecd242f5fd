// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/answers/json.h"

namespace tenon::answers {

Json parsed(std::string_view text) { return Json::parse(text, nullptr, false); }

std::string printed(const Json& json, bool only_ascii, int indent) {
  return json.dump(indent, ' ', only_ascii, Json::error_handler_t::replace) + "\n";
}

std::string on_one_line(const Json& json, bool only_ascii) {
  return json.dump(-1, ' ', only_ascii, Json::error_handler_t::replace);
}

}  // namespace tenon::answers
