// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/text/where_text.h"

#include "tenon/answers/opinions.h"
#include "tenon/base/text/rounded_text.h"

namespace tenon::cli {
namespace {

/// "through variant Physics=physx (hand.usda:12), payload @payloads/Physics/physx.usda@".
std::string way_text(const Json& row) {
  std::string text;
  for (const Json& arc : row["arcs"]) {
    text += text.empty() ? "through " : ", ";
    text += arc["arc"].get<std::string>();
    text += arc.contains("set")
                ? " " + arc["set"].get<std::string>() + "=" + arc["variant"].get<std::string>()
                : " of <" + arc["to"].get<std::string>() + ">";
    if (!arc["file"].is_null()) {
      text += " (" + arc["file"].get<std::string>();
      text += arc["line"].is_null() ? ")" : ":" + std::to_string(arc["line"].get<unsigned>()) + ")";
    }
  }
  if (!row["sublayerOf"].is_null()) {
    text += (text.empty() ? "a sublayer of " : ", a sublayer of ") +
            row["sublayerOf"].get<std::string>();
  }
  return text;
}

/// The way there is said once for rows of one place.
std::string where_row_text(const Json& row, std::string& last_way) {
  const bool fallback = row["what"] == "fallback";
  const std::string verdict = row["verdict"].get<std::string>();
  const bool counts = verdict.starts_with("wins") || verdict == "combined";
  std::string text = counts ? "  > " : "    ";
  if (fallback) {
    text += "schema" + (row["schema"].is_null() ? "" : " " + row["schema"].get<std::string>());
  } else {
    text += answers::place_text(row);
  }
  text += "  " + row["what"].get<std::string>();
  text += row["value"].is_null() ? "" : " = " + row["value"].get<std::string>();
  text += "  [" + verdict;
  text += row["why"].is_null() ? "]\n" : ": " + row["why"].get<std::string>() + "]\n";
  const std::string place = fallback ? "" : answers::place_text(row);
  const std::string way = way_text(row);
  const bool known = last_way == place + way;
  last_way = place + way;
  return way.empty() || known ? text : text + "        " + way + "\n";
}

std::string value_line(const Json& answer) {
  if (!answer.contains("value")) {
    return "";
  }
  std::string text = "  value ";
  if (answer["value"].is_array()) {
    for (const Json& item : answer["value"]) {
      text += "<" + item.get<std::string>() + "> ";
    }
    return (answer["value"].empty() ? text + "none" : text) + "\n";
  }
  text += answer["value"].is_null() ? "none" : answer["value"].get<std::string>();
  text += "  (" + answer["source"].get<std::string>() + ")\n";
  if (answer.contains("time")) {
    text += "  at time " + rounded_text(answer["time"].get<double>()) + ": ";
    text += answer["valueAtTime"].is_null() ? "none" : answer["valueAtTime"].get<std::string>();
    text += "  (" + answer["sourceAtTimes"].get<std::string>() + ")\n";
  }
  return text;
}

}  // namespace

std::string where_text(const Json& answer) {
  std::string text = answer["prim"].get<std::string>();
  text += answer["property"].is_null() ? "" : "." + answer["property"].get<std::string>();
  text += "  " + answer["type"].get<std::string>() + "\n" + value_line(answer);
  text += answer["opinions"].empty() ? "  no opinion\n" : "  opinions, strongest first\n";
  std::string last_way;
  for (const Json& row : answer["opinions"]) {
    text += where_row_text(row, last_way);
  }
  return text;
}

}  // namespace tenon::cli
