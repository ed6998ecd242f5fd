// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/exporting/ros2_control.h"

#include <cmath>

#include "tenon/base/text/source_number.h"
#include "tenon/urdf/xml_writer.h"

namespace tenon {
namespace {

struct Command {
  const char* interface;
  double lower;
  double upper;
};

Command command_of(const JointMotor& motor) {
  if (motor.driven && motor.stiffness != 0) {
    return {"position", motor.lower, motor.upper};
  }
  if (motor.driven) {
    return {"velocity", -motor.velocity_limit, motor.velocity_limit};
  }
  return {"effort", -motor.effort_limit, motor.effort_limit};
}

void write_command(urdf::XmlWriter& out, const JointMotor& motor) {
  const Command command = command_of(motor);
  if (!std::isfinite(command.lower) && !std::isfinite(command.upper)) {
    out.empty("command_interface", {{"name", command.interface}});
    return;
  }
  out.open("command_interface", {{"name", command.interface}});
  if (std::isfinite(command.lower)) {
    out.leaf("param", source_number(command.lower), {{"name", "min"}});
  }
  if (std::isfinite(command.upper)) {
    out.leaf("param", source_number(command.upper), {{"name", "max"}});
  }
  out.close("command_interface");
}

void write_joint(urdf::XmlWriter& out, const JointMotor& motor) {
  urdf::XmlWriter::AttributeList attributes{{"name", motor.name}};
  if (motor.leader) {
    attributes.emplace_back("mimic", "true");
  }
  out.open("joint", attributes);
  if (!motor.leader) {
    write_command(out, motor);
  }
  out.open("state_interface", {{"name", "position"}});
  out.leaf("param", source_number(motor.start), {{"name", "initial_value"}});
  out.close("state_interface");
  out.empty("state_interface", {{"name", "velocity"}});
  if (!motor.leader) {
    out.empty("state_interface", {{"name", "effort"}});
  }
  out.close("joint");
}

}  // namespace

std::string ros2_control_block(const std::string& robot, const std::vector<JointMotor>& motors) {
  urdf::XmlWriter out = urdf::XmlWriter::part(1);
  out.open("ros2_control", {{"name", robot}, {"type", "system"}});
  out.open("hardware");
  out.leaf("plugin", kMockHardware);
  out.close("hardware");
  for (const JointMotor& motor : motors) {
    write_joint(out, motor);
  }
  out.close("ros2_control");
  return out.take();
}

}  // namespace tenon
