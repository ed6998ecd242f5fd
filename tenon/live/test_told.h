// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "tenon/live/session.h"

/// For tests: whether what a session tells is as the tables of messages say.
namespace tenon::live {

/// Expects what a JSON Schema allows, as far as messages_json uses that.
inline void expect_allowed(const Json& value, const Json& allowed, const std::string& place) {
  EXPECT_NE(allowed, false) << place << " is in no table";
  const Json schema = allowed.is_object() ? allowed : Json::object();
  const std::string types = schema.value("type", Json(value.type_name())).dump();
  const bool whole = value.is_number_integer() && types.find("number") == std::string::npos;
  EXPECT_NE(types.find(whole ? "integer" : value.type_name()), std::string::npos)
      << place << " is no " << types << ": " << value;
  const Json required = value.is_object() ? schema.value("required", Json::array()) : Json();
  for (const Json& name : required) {
    EXPECT_TRUE(value.contains(name.get<std::string>())) << place << " has no " << name;
  }
  const Json members = value.is_structured() ? value : Json();
  const Json known = schema.value("properties", Json::object());
  const Json others = schema.value("additionalProperties", Json(true));
  for (const auto& [key, one] : members.items()) {
    const Json& of =
        value.is_array() ? schema.value("items", Json(true)) : known.value(key, others);
    expect_allowed(one, of, place + "." + key);
  }
}

/// A notice, and the result in an answer.
inline void expect_as_told(const Json& notice) {
  static const Json tables = messages_json(requests());
  for (const Json& row : tables["notices"]) {
    if (row["name"] == notice["is"]) {
      expect_allowed(notice, row["schema"], row["name"]);
    }
  }
  for (const Json& row : tables["requests"]) {
    if (notice["is"] == "answer" && row["name"] == notice["to"]) {
      expect_allowed(notice["result"], row["result"], row["name"]);
    }
  }
}

}  // namespace tenon::live
