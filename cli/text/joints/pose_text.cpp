// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/text/joints/pose_text.h"

#include <cmath>
#include <vector>

#include "cli/text/text_table.h"
#include "tenon/base/text/counted.h"
#include "tenon/base/text/rounded_text.h"

namespace tenon::cli {
namespace {

using answers::Json;

bool joint_turns(const Json& joint) {
  return joint["dof"].is_string() && joint["dof"].get<std::string>().starts_with("rot");
}

std::string value_in_units(const Json& value, bool angle) {
  const double number = value.get<double>() * (angle ? 180 / M_PI : 1);
  return rounded_text(std::abs(number) < 1e-9 ? 0 : number);
}

std::string limits_text(const Json& joint) {
  if (joint["lower"].is_null() && joint["upper"].is_null()) {
    return "no limits";
  }
  const auto bound = [&](const char* key, const char* none) {
    return joint[key].is_null() ? std::string(none)
                                : value_in_units(joint[key], joint_turns(joint));
  };
  return bound("lower", "-inf") + " .. " + bound("upper", "inf");
}

std::string end_of_path(const Json& path) {
  const auto text = path.get<std::string>();
  return text.substr(text.rfind('/') + 1);
}

std::string notes_text(const Json& joint) {
  std::string text;
  const auto add = [&](const std::string& note) { text += (text.empty() ? "" : ", ") + note; };
  if (joint["problem"] == "missing") {
    add("no joint of this name here");
  } else if (joint["problem"] == "outside") {
    add("beyond its limits");
  }
  if (!joint["follows"].is_null()) {
    add("follows " + end_of_path(joint["follows"]));
  }
  if (joint["fixed"].get<bool>()) {
    add("held");
  }
  return text;
}

std::string joints_text(const Json& joints) {
  std::vector<std::vector<std::string>> rows;
  rows.push_back({"joint", "at", "", "limits", ""});
  for (const Json& joint : joints) {
    const bool known = !joint["value"].is_null();
    rows.push_back({joint["joint"].get<std::string>(),
                    known ? value_in_units(joint["value"], joint_turns(joint)) : "-",
                    !known               ? ""
                    : joint_turns(joint) ? "deg"
                                         : "m",
                    known ? limits_text(joint) : "", notes_text(joint)});
  }
  return rows.size() == 1 ? "no joint has a value\n" : text_table(rows);
}

std::size_t problems_of(const Json& pose) {
  std::size_t count = 0;
  for (const Json& joint : pose["joints"]) {
    count += joint["problem"].is_null() ? 0U : 1U;
  }
  return count;
}

std::string place_text(const Json& place) {
  return "(" + value_in_units(place[0], false) + ", " + value_in_units(place[1], false) + ", " +
         value_in_units(place[2], false) + ") m";
}

}  // namespace

std::string named_poses_text(const Json& poses) {
  std::vector<std::vector<std::string>> rows;
  rows.push_back({"pose", "joints", "end link", ""});
  for (const Json& pose : poses["poses"]) {
    const std::size_t problems = problems_of(pose);
    std::string note = pose["valid"].get<bool>() ? "" : "marked as not valid";
    if (problems > 0) {
      note += (note.empty() ? "" : ", ") + counted(problems, "joint") + " missing or beyond limits";
    }
    rows.push_back({pose["name"].get<std::string>(), std::to_string(pose["joints"].size()),
                    pose["endLink"].is_null() ? "-" : pose["endLink"].get<std::string>(), note});
  }
  return rows.size() == 1 ? "the asset keeps no named poses\n" : text_table(rows);
}

std::string named_pose_text(const Json& pose) {
  const Json& named = pose["pose"];
  std::string text = named["path"].get<std::string>();
  text += named["valid"].get<bool>() ? "\n" : "  (marked as not valid)\n";
  if (!named["endLink"].is_null()) {
    text += "end link " + named["endLink"].get<std::string>() + "\n";
  }
  return text + joints_text(named["joints"]);
}

std::string reach_text(const Json& reach, const std::string& obstacle) {
  std::string text;
  for (const Json& target : reach["targets"]) {
    text += target["prim"].get<std::string>() + " at " + place_text(target["at"]) + ", " +
            rounded_text(target["distance"].get<double>() * 1000, 3) + " mm";
    if (!target["angle"].is_null()) {
      text += " and " + rounded_text(target["angle"].get<double>() * 180 / M_PI, 3) + " deg";
    }
    text += " from " + place_text(target["position"]) + "\n";
  }
  if (!reach["reached"].get<bool>()) {
    return text + "not reached: " + obstacle + "\n";
  }
  return text + "reached after " + counted(reach["starts"].get<std::size_t>(), "start") + "\n";
}

std::string posture_text(const Json& posture, const std::string& obstacle) {
  std::string text = joints_text(posture["joints"]);
  if (posture.contains("reach")) {
    text += reach_text(posture["reach"], obstacle);
  }
  return text;
}

}  // namespace tenon::cli
