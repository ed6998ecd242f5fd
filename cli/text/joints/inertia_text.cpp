// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/text/joints/inertia_text.h"

#include <cmath>
#include <vector>

#include "cli/text/text_table.h"
#include "tenon/base/text/rounded_text.h"

namespace tenon::cli {
namespace {

using answers::Json;

std::string number(const Json& value) {
  return value.is_null() ? "-" : rounded_text(value.get<double>());
}

std::string position(const Json& row, bool turns) {
  if (row["position"].is_null()) {
    return "floats";
  }
  const double at = row["position"].get<double>();
  return turns ? rounded_text(at * 180 / M_PI) + " deg" : rounded_text(at) + " m";
}

std::vector<std::string> row_of(const Json& row) {
  const std::string dof = row["dof"].get<std::string>();
  const bool turns = dof.starts_with("rot");
  const std::string name = (row["joint"].is_null() ? row["body"] : row["joint"]).get<std::string>();
  return {name,
          dof,
          position(row, turns),
          number(row["held"]),
          number(row["free"]),
          turns ? "kg m^2" : "kg",
          row["gravity"].is_number() && std::abs(row["gravity"].get<double>()) < 1e-12
              ? "0"  // rounding errors of sums that cancel
              : number(row["gravity"]),
          turns ? "N m" : "N"};
}

}  // namespace

std::string inertia_text(const Json& inertia) {
  const Json& center = inertia["centerOfMass"];
  std::string text = "mass " + number(inertia["mass"]) + " kg, centre of mass (" +
                     number(center[0]) + ", " + number(center[1]) + ", " + number(center[2]) +
                     ") m\n";
  constexpr double kOpen = 1e-6;
  if (inertia["loopGap"].get<double>() > kOpen) {
    text += "loops are open by " + rounded_text(inertia["loopGap"].get<double>() * 1000) +
            " mm at this pose\n";
  }
  std::vector<std::vector<std::string>> rows;
  rows.push_back({"joint", "dof", "at", "others held", "others free", "", "gravity", ""});
  for (const Json& row : inertia["coordinates"]) {
    rows.push_back(row_of(row));
  }
  return rows.size() == 1 ? text + "nothing moves\n" : text + text_table(rows);
}

}  // namespace tenon::cli
