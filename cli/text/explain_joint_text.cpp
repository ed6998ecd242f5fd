// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/text/explain_text.h"
#include "tenon/base/text/rounded_text.h"
#include "tenon/math/angle.h"

namespace tenon::cli {
namespace {

std::string text(const Json& value) {
  if (value.is_null()) {
    return "unlimited";
  }
  return rounded_text(value.get<double>());
}

std::string point_text(const Json& v) {
  return "(" + text(v[0]) + ", " + text(v[1]) + ", " + text(v[2]) + ")";
}

std::string side_text(const Json& side, const char* name) {
  std::string line = std::string("    ") + name + ": ";
  line += side["body"].is_null() ? std::string("world") : side["body"].get<std::string>();
  if (!side["target"].is_null() && side["target"] != side["body"]) {
    line += " (named: " + side["target"].get<std::string>() + ")";
  }
  return line + ", frame at " + point_text(side["frame"]["position"]) + " m, in the world at " +
         point_text(side["world"]["position"]) + " m\n      " + side["why"].get<std::string>() +
         "\n";
}

std::string bound_text(const Json& value, bool angular) {
  return value.is_null() ? "unlimited"
                         : rounded_text(value.get<double>() * (angular ? kDegreesPerRadian : 1)) +
                               (angular ? " deg" : " m");
}

std::string dof_text(const Json& row) {
  const bool angular = row["angular"].get<bool>();
  std::string line = "    " + row["dof"].get<std::string>() + "  ";
  if (row["locked"].get<bool>()) {
    line += "locked";
  } else if (row["lower"].is_null() && row["upper"].is_null()) {
    line += "free";
  } else {
    line += bound_text(row["lower"], angular) + " to " + bound_text(row["upper"], angular);
  }
  const Json& drive = row["drive"];
  if (!drive.is_null()) {
    line += ", " + drive["type"].get<std::string>() + " drive from " +
            drive["source"].get<std::string>() + ": stiffness " + text(drive["stiffness"]) +
            ", damping " + text(drive["damping"]) +
            (drive["maxForce"].is_null() ? ", no force limit"
                                         : ", at most " + text(drive["maxForce"])) +
            ", to " + text(drive["targetPosition"]) + " at " + text(drive["targetVelocity"]) +
            " (SI, radians)";
  }
  return line + "\n";
}

/// "the axis X tilts toward Y by at most 20 deg, toward Z freely".
std::string cones_text(const Json& cones) {
  std::string line = "    the axis " + cones["axis"].get<std::string>() + " tilts";
  const char* joint = " toward ";
  for (const Json& side : cones["toward"]) {
    line +=
        joint + side["axis"].get<std::string>() +
        (side["limit"].is_null() ? " freely" : " by at most " + bound_text(side["limit"], true)) +
        " (" + side["property"].get<std::string>() + ")";
    joint = ", toward ";
  }
  return line + " [S-96]\n";
}

std::string breaking_text(const Json& force, const Json& torque) {
  if (force.is_null() && torque.is_null()) {
    return "never breaks";
  }
  return "breaks above " + (force.is_null() ? "" : text(force) + " N") +
         (force.is_null() || torque.is_null() ? "" : " or ") +
         (torque.is_null() ? "" : text(torque) + " N m");
}

}  // namespace

std::string joint_text(const Json& joint) {
  std::string text_of = "  joint: " + joint["type"].get<std::string>() +
                        (joint["enabled"].get<bool>() ? "\n" : ", disabled [S-91]\n");
  text_of += side_text(joint["side0"], "body0") + side_text(joint["side1"], "body1");
  text_of += "    at the start frame 1 is " + text(joint["start"]["distance"]) + " m and " +
             rounded_text(joint["start"]["angle"].get<double>() * kDegreesPerRadian) +
             " deg away from frame 0\n";
  for (const Json& row : joint["dofs"]) {
    text_of += dof_text(row);
  }
  text_of += joint["cones"].is_null() ? "" : cones_text(joint["cones"]);
  text_of += joint["collisionEnabled"].get<bool>()
                 ? "    the jointed sides may touch [S-92]\n"
                 : "    the jointed sides do not touch, where both are named [S-92]\n";
  text_of += "    " + breaking_text(joint["breakForce"], joint["breakTorque"]) + " [S-93]\n";
  if (!joint["articulation"].is_null()) {
    text_of += "    of the articulation " + joint["articulation"]["path"].get<std::string>() + "\n";
  }
  text_of += joint["loop"].get<bool>() ? "    closes a loop: kept as a constraint [S-111]\n" : "";
  return text_of;
}

}  // namespace tenon::cli
