// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/mass_report.h"

#include <algorithm>

#include "cli/opinions.h"
#include "tenon/base/rounded_text.h"

namespace tenon::cli {
namespace {

using physics::MassAccount;
using physics::MassQuantity;

Json vector_json(const Vec3d& v) { return Json::array({v[0], v[1], v[2]}); }

Json matrix_json(const Mat3d& m) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      rows.push_back(m[i][j]);
    }
  }
  return rows;
}

Json properties_json(const physics::MassProperties& properties) {
  return {{"mass", properties.mass},
          {"centerOfMass", vector_json(properties.center)},
          {"inertia", matrix_json(properties.inertia)}};
}

template <class T, class ToJson>
Json or_null(const std::optional<T>& value, ToJson to_json) {
  return value ? Json(to_json(*value)) : Json(nullptr);
}

Json authored_json(const physics::AuthoredMass& authored) {
  const auto number = [](double x) { return x; };
  return {{"mass", or_null(authored.mass, number)},
          {"density", or_null(authored.density, number)},
          {"centerOfMass", or_null(authored.center, vector_json)},
          {"inertia", or_null(authored.inertia, matrix_json)}};
}

Json candidate_json(const stage::Stage& stage, const physics::MassCandidate& candidate) {
  Json row = Json::object();
  row["quantity"] = physics::mass_quantity_name(candidate.quantity);
  row["used"] = candidate.used;
  row["value"] = candidate.value.empty() ? Json(nullptr) : Json(candidate.value);
  row["prim"] = candidate.prim.empty() ? Json(nullptr) : Json(candidate.prim.str());
  row["property"] = candidate.property.empty() ? Json(nullptr) : Json(candidate.property.str());
  row["rule"] = candidate.rule;
  row["why"] = candidate.why;
  row["opinions"] = candidate.property.empty()
                        ? Json::array()
                        : opinions_json(stage.prim(candidate.prim), candidate.property);
  return row;
}

std::string candidate_text(const Json& row, const std::string& indent) {
  std::string text = indent + (row["used"].get<bool>() ? "> " : "  ");
  text += row["value"].is_null() ? std::string("-") : row["value"].get<std::string>();
  if (!row["property"].is_null()) {
    text += "  " + row["prim"].get<std::string>() + "." + row["property"].get<std::string>();
  }
  text += "  " + row["why"].get<std::string>() + " [" + row["rule"].get<std::string>() + "]\n";
  return text + opinions_text(row["opinions"], indent + "    ");
}

/// One used candidate in a few words: "authored, scene.usda:4:5" or the rule's own.
std::string reason_of(const Json& mass, const char* quantity) {
  for (const Json& row : mass["candidates"]) {
    if (row["quantity"] != quantity || !row["used"].get<bool>()) {
      continue;
    }
    if (row["property"].is_null() || row["opinions"].empty()) {
      return row["why"].get<std::string>();
    }
    return "authored, " + place_text(row["opinions"][0]);
  }
  return "";
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

/// Columns as wide as their widest cell.
std::string columns(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], row[i].size());
    }
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += row[i];
      if (i + 1 < row.size()) {
        line += std::string(widths[i] - row[i].size() + 2, ' ');
      }
    }
    text += line + "\n";
  }
  return text;
}

}  // namespace

Json mass_json(const stage::Stage& stage, const physics::PhysicsScene& scene,
               const MassAccount& account) {
  Json mass = Json::object();
  mass["authored"] = authored_json(account.authored);
  mass["computed"] = account.computed.mass > 0 ? properties_json(account.computed) : Json(nullptr);
  mass["resolved"] = properties_json(account.result);
  mass["candidates"] = Json::array();
  for (const physics::MassCandidate& candidate : account.candidates) {
    mass["candidates"].push_back(candidate_json(stage, candidate));
  }
  mass["colliders"] = Json::array();
  for (const physics::ColliderMass& part : account.colliders) {
    Json row = {{"path", scene.colliders[part.collider].path.str()},
                {"counted", part.counted},
                {"volume", part.volume}};
    row.update(properties_json(part.properties));
    row["candidates"] = Json::array();
    for (const physics::MassCandidate& candidate : part.candidates) {
      row["candidates"].push_back(candidate_json(stage, candidate));
    }
    mass["colliders"].push_back(std::move(row));
  }
  return mass;
}

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

Json mass_table_json(const stage::Stage& stage, const physics::PhysicsScene& scene,
                     const physics::Accounts& accounts) {
  Json table = Json::array();
  for (const MassAccount& account : accounts.masses) {
    Json row = {{"path", scene.bodies[account.body].path.str()}};
    const Json mass = mass_json(stage, scene, account);
    row["authored"] = mass["authored"];
    row["resolved"] = mass["resolved"];
    row["reason"] = {{"mass", reason_of(mass, "mass")},
                     {"centerOfMass", reason_of(mass, "centerOfMass")},
                     {"inertia", reason_of(mass, "inertia")}};
    table.push_back(std::move(row));
  }
  return table;
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
  return columns(rows);
}

}  // namespace tenon::cli
