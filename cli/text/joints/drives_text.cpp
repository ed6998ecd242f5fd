// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/text/joints/drives_text.h"

#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

#include "cli/text/text_table.h"
#include "tenon/base/text/counted.h"
#include "tenon/base/text/rounded_text.h"

namespace tenon::cli {
namespace {

using answers::Json;

constexpr double kDegreesOfRadian = 180 / M_PI;

bool turns(const Json& row) { return row["dof"].get<std::string>().starts_with("rot"); }

/// Sums that cancel leave rounding errors, which tables show as 0.
std::string effort(const Json& value, bool angular) {
  if (value.is_null()) {
    return "unlimited";
  }
  const double number = value.get<double>();
  return rounded_text(std::abs(number) < 1e-12 ? 0 : number) + (angular ? " N m" : " N");
}

std::string speed(const Json& value, bool angular) {
  if (value.is_null()) {
    return "unlimited";
  }
  return angular ? rounded_text(value.get<double>() * kDegreesOfRadian) + " deg/s"
                 : rounded_text(value.get<double>()) + " m/s";
}

std::string range(const Json& pair) {
  const auto text = [](const Json& value) {
    return value.is_null() ? std::string("-") : rounded_text(value.get<double>());
  };
  const std::string least = text(pair[0]);
  const std::string most = text(pair[1]);
  return least == most ? least : least + " to " + most;
}

std::string to_new(const std::string& before, const std::string& after) {
  return before == after ? before : before + " -> " + after;
}

std::string followers(const Json& paths) {
  std::string names;
  for (const Json& path : paths) {
    const std::string text = path.get<std::string>();
    names += (names.empty() ? "" : ", ") + text.substr(text.rfind('/') + 1);
  }
  return names;
}

std::vector<std::string> drive_row(const Json& drive) {
  const bool angular = turns(drive);
  const Json& new_effort = drive["newMaxEffort"];
  const Json& new_speed = drive["newSpeedLimit"];
  std::string weight = "not known";
  if (!drive["weight"].is_null()) {
    const double at = drive["weightAt"].get<double>() * (angular ? kDegreesOfRadian : 1);
    weight =
        effort(drive["weight"], angular) + " at " + rounded_text(at) + (angular ? " deg" : " m");
  }
  const std::string old_effort = effort(drive["maxEffort"], angular);
  const std::string old_speed = speed(drive["speedLimit"], angular);
  return {drive["joint"].get<std::string>(),
          to_new(old_effort, new_effort.is_null() ? old_effort : effort(new_effort, angular)),
          to_new(old_speed, new_speed.is_null() ? old_speed : speed(new_speed, angular)),
          weight + (drive["tooWeak"].get<bool>() ? " (too weak)" : ""),
          range(drive["inertia"]) + (angular ? " kg m^2" : " kg"),
          followers(drive["followers"])};
}

}  // namespace

std::string drives_text(const Json& drives) {
  if (drives["drives"].empty()) {
    const std::string advice =
        "to give each one: tenon add ASSET '.*=drive' --match --stiffness 10 --damping 1";
    return "no joint has a drive; " + advice + "\n";
  }
  std::vector<std::vector<std::string>> rows;
  rows.push_back({"joint", "max effort", "speed limit", "weight to hold", "inertia", "followers"});
  for (const Json& drive : drives["drives"]) {
    rows.push_back(drive_row(drive));
  }
  std::string text = text_table(rows);
  const auto postures = drives["postures"].get<std::size_t>();
  text += postures == 1 ? "weight and inertia at the start; --sample N looks at N more postures\n"
                        : "weight and inertia: the worst of " + counted(postures, "posture") + "\n";
  std::vector<std::vector<std::string>> mimics;
  mimics.push_back({"follower", "leader", "multiplier", "compliance"});
  for (const Json& follower : drives["followers"]) {
    const double frequency = follower["naturalFrequency"].get<double>();
    mimics.push_back({follower["joint"].get<std::string>(), follower["leader"].get<std::string>(),
                      rounded_text(follower["multiplier"].get<double>()),
                      frequency == 0 ? "rigid"
                                     : rounded_text(frequency) + " rad/s, ratio " +
                                           rounded_text(follower["dampingRatio"].get<double>())});
  }
  return mimics.size() == 1 ? text : text + "\n" + text_table(mimics);
}

}  // namespace tenon::cli
