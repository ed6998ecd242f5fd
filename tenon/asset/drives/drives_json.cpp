// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/drives/drives_json.h"

#include <string>
#include <utility>

#include "tenon/answers/or_null.h"

namespace tenon {
namespace {

using answers::finite_or_null;
using answers::Json;

Json drive_demand_json(const DriveDemand& drive) {
  Json row = Json::object();
  row["joint"] = drive.joint.str();
  row["dof"] = std::string(dof_name(drive.dof));
  row["type"] = drive.acceleration ? "acceleration" : "force";
  row["stiffness"] = drive.stiffness;
  row["damping"] = drive.damping;
  row["maxEffort"] = finite_or_null(drive.max_effort);
  row["speedLimit"] = finite_or_null(drive.speed_limit);
  row["weight"] = finite_or_null(drive.weight);
  row["weightAt"] = drive.weight_at;
  row["inertia"] =
      Json::array({finite_or_null(drive.least_inertia), finite_or_null(drive.most_inertia)});
  row["tooWeak"] = drive.is_too_weak();
  row["followers"] = Json::array();
  for (const Path& follower : drive.followers) {
    row["followers"].push_back(follower.str());
  }
  row["newMaxEffort"] = drive.new_effort ? finite_or_null(*drive.new_effort) : Json(nullptr);
  row["newSpeedLimit"] = drive.new_speed ? finite_or_null(*drive.new_speed) : Json(nullptr);
  return row;
}

}  // namespace

Json drives_json(const DrivesOfAsset& found) {
  Json result = Json::object();
  result["postures"] = found.postures;
  result["drives"] = Json::array();
  for (const DriveDemand& drive : found.drives) {
    result["drives"].push_back(drive_demand_json(drive));
  }
  result["followers"] = Json::array();
  for (const FollowerOfDrive& follower : found.followers) {
    result["followers"].push_back({{"joint", follower.joint.str()},
                                   {"leader", follower.leader.str()},
                                   {"multiplier", follower.multiplier},
                                   {"naturalFrequency", follower.frequency},
                                   {"dampingRatio", follower.ratio}});
  }
  return result;
}

}  // namespace tenon
