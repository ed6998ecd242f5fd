// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/text/mass_text.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "cli/text/opinions_text.h"
#include "cli/text/text_table.h"
#include "tenon/base/text/rounded_text.h"

namespace tenon::cli {
namespace {

std::string candidate_text(const Json& row, const std::string& indent) {
  std::string text = indent + (row["used"].get<bool>() ? "> " : "  ");
  text += row["value"].is_null() ? std::string("-") : row["value"].get<std::string>();
  if (!row["property"].is_null()) {
    text += "  " + row["prim"].get<std::string>() + "." + row["property"].get<std::string>();
  }
  text += "  " + row["why"].get<std::string>() + " [" + row["rule"].get<std::string>() + "]\n";
  return text + opinions_text(row["opinions"], indent + "    ");
}

std::string vector_text(const Json& v) {
  return "(" + rounded_text(v[0].get<double>()) + ", " + rounded_text(v[1].get<double>()) + ", " +
         rounded_text(v[2].get<double>()) + ")";
}

std::string shown(const Json& value) {
  return value.is_null()     ? std::string("-")
         : value.is_number() ? rounded_text(value.get<double>())
         : value.size() == 3 ? vector_text(value)
                             : "(" + rounded_text(value[0].get<double>()) + ", " +
                                   rounded_text(value[4].get<double>()) + ", " +
                                   rounded_text(value[8].get<double>()) + ")";
}

}  // namespace

std::string mass_text(const Json& mass, const std::string& indent) {
  const Json& resolved = mass["resolved"];
  std::string text = indent + "mass " + shown(resolved["mass"]) + " kg, centre of mass " +
                     shown(resolved["centerOfMass"]) + " m, inertia about it (xx, yy, zz) " +
                     shown(resolved["inertia"]) + " kg m^2\n";
  for (const char* quantity : {"mass", "centerOfMass", "inertia"}) {
    text += indent + "  " + quantity + ", strongest first\n";
    for (const Json& row : mass["candidates"]) {
      if (row["quantity"] == quantity) {
        text += candidate_text(row, indent + "    ");
      }
    }
  }
  for (const Json& part : mass["colliders"]) {
    text += indent + "  collider " + part["path"].get<std::string>();
    if (!part["counted"].get<bool>()) {
      text += "  disabled: weighs nothing [S-43]\n";
      continue;
    }
    text += "  volume " + shown(part["volume"]) + " m^3, mass " + shown(part["mass"]) + " kg, at " +
            shown(part["centerOfMass"]) + " m\n";
    for (const Json& row : part["candidates"]) {
      text += candidate_text(row, indent + "    ");
    }
  }
  return text;
}

std::string mass_table_text(const Json& table) {
  std::vector<std::vector<std::string>> rows;
  rows.push_back({"body", "quantity", "authored", "resolved", "reason"});
  static constexpr std::pair<const char*, const char*> kQuantities[] = {
      {"mass", "mass [kg]"},
      {"centerOfMass", "centre of mass [m]"},
      {"inertia", "inertia xx, yy, zz [kg m^2]"}};
  for (const Json& row : table) {
    for (const auto& [key, name] : kQuantities) {
      rows.push_back({key == kQuantities[0].first ? row["path"].get<std::string>() : "", name,
                      shown(row["authored"][key]), shown(row["resolved"][key]),
                      row["reason"][key].get<std::string>()});
    }
  }
  return text_table(rows);
}

}  // namespace tenon::cli
