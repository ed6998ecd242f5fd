// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/robot/robot_model.h"

#include "tenon/base/file_finding.h"
#include "tenon/math/inertia.h"

namespace tenon::robot {

Mat3d Inertial::inertia_in_link() const {
  return axes == kIdentityRotation ? inertia : rotate_inertia(axes, inertia);
}

std::string_view geometry_name(GeometryKind kind) {
  constexpr std::string_view kNames[] = {"box",     "sphere", "ellipsoid", "cylinder",
                                         "capsule", "plane",  "mesh"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string_view joint_kind_name(JointKind kind) {
  constexpr std::string_view kNames[] = {"fixed", "revolute", "continuous", "prismatic",
                                         "ball",  "planar",   "floating"};
  return kNames[static_cast<std::size_t>(kind)];
}

Diagnostic at_place(Diagnostic finding, const Place& place) {
  finding.line = place.line;
  finding.column = place.column;
  finding.end_line = place.end_line;
  finding.end_column = place.end_column;
  return finding;
}

Diagnostic model_finding(const RobotModel& model, const Place& place, Severity severity,
                         std::string rule, std::string message, std::string fix) {
  return at_place(
      file_finding(severity, std::move(rule), std::move(message), model.file, 0, std::move(fix)),
      place);
}

}  // namespace tenon::robot
