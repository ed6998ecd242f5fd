// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Both programs match joints by regular expressions of the whole name, and take numbers in SI per
// radian. Names of prims are plain; those of MJCF may hold marks of expressions, which are escaped.
// Isaac Lab 2 writes the scalar of a rotation first, Isaac Lab 3 last: the file asks which it is.
// A limit that the asset lacks is None, so that the one of the USD file counts.
#include "tenon/asset/exporting/python_cfg.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "tenon/base/text/source_number.h"

namespace tenon {
namespace {

/// A name as a regular expression that nothing else matches.
std::string exact(const std::string& name) {
  std::string out;
  for (const char c : name) {
    if (std::string_view("\\.^$*+?{}[]|()").find(c) != std::string_view::npos) {
      out += '\\';
    }
    out += c;
  }
  return out;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  return text;
}

/// A float of Python: one without a point or an exponent gets ".0".
std::string float_text(double number) {
  const std::string text = source_number(number);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string tuple_of(std::initializer_list<double> numbers) {
  std::string out = "(";
  for (const double number : numbers) {
    out += (out.size() == 1 ? "" : ", ") + float_text(number);
  }
  return out + ")";
}

using NameOf = const std::string& (*)(const JointMotor&);
const std::string& prim_name(const JointMotor& motor) { return motor.prim; }
const std::string& model_name(const JointMotor& motor) { return motor.name; }

/// Lines of a dictionary from joints to coordinates.
std::string positions(const RobotCfg& robot, NameOf name_of, const std::string& indent) {
  std::string out;
  for (const JointMotor& motor : robot.motors) {
    out += indent + python_text(exact(name_of(motor))) + ": " + float_text(motor.start) + ",\n";
  }
  return out;
}

std::string pose_lines(const RobotCfg& robot, NameOf name_of, const std::string& upper_name) {
  if (robot.poses.empty()) {
    return {};
  }
  std::string out = "\n" + upper_name + "_POSES = {\n";
  for (const auto& [name, joints] : robot.poses) {
    out += "    " + python_text(name) + ": {";
    for (std::size_t i = 0; i < joints.size(); ++i) {
      out += (i == 0 ? "" : ", ") + python_text(exact(name_of(robot.motors[joints[i].first]))) +
             ": " + float_text(joints[i].second);
    }
    out += "},\n";
  }
  return out + "}\n\"\"\"Poses that the asset keeps, for init_state.joint_pos [rad or m].\"\"\"\n";
}

std::string head(const RobotCfg& robot, const std::string& of) {
  std::string out = "\"\"\"" + of + " of the robot " + python_name(robot.name) +
                    ".\n\nNumbers are SI: metres, radians, N m/rad and N m s/rad, of slides N/m "
                    "and N s/m.\n";
  for (const std::string& sentence : robot.left_out) {
    out += "Not in it: " + sentence + ".\n";
  }
  return out + "\"\"\"\n\n";
}

std::string names_list(const RobotCfg& robot, const MotorGroup& group, NameOf name_of,
                       const std::string& indent) {
  std::string out;
  for (const std::size_t i : group.motors) {
    out += indent + python_text(exact(name_of(robot.motors[i]))) + ",\n";
  }
  return out;
}

std::string number_or_none(double value) {
  return std::isfinite(value) ? float_text(value) : "None";
}

/// One row of `actuators`. None is what the USD file says.
std::string isaaclab_group(const RobotCfg& robot, const MotorGroup& group) {
  const JointMotor& motor = robot.motors[group.motors.front()];
  const std::string indent = "            ";
  const auto row = [&](const char* name, const std::string& value) {
    return indent + name + "=" + value + ",\n";
  };
  std::string out = "        " + python_text(group.name) + ": ImplicitActuatorCfg(\n" + indent +
                    "joint_names_expr=[\n" +
                    names_list(robot, group, prim_name, "                ") + indent + "],\n" +
                    indent + "**_limits(effort=" + number_or_none(motor.effort_limit) +
                    ", velocity=" + number_or_none(motor.velocity_limit) + "),\n";
  out += row("stiffness", motor.per_inertia ? "None" : float_text(motor.stiffness));
  out += row("damping", motor.per_inertia ? "None" : float_text(motor.damping));
  out += row("armature", float_text(motor.armature));
  out += row("friction", float_text(motor.friction));
  out += row("dynamic_friction", float_text(motor.friction));
  out += row("viscous_friction", float_text(motor.passive_damping));
  return out + "        ),\n";
}

/// What differs between the versions.
constexpr const char* kIsaacLabVersions =
    "\n_IS_3 = \"joint_effort_limit\" in ImplicitActuatorCfg.__dataclass_fields__\n\n\n"
    "def _limits(effort, velocity):\n"
    "    \"\"\"Limits of the solver by their names in Isaac Lab 3, or in Isaac Lab 2.\"\"\"\n"
    "    if _IS_3:\n"
    "        return {\"joint_effort_limit\": effort, \"joint_velocity_limit\": velocity}\n"
    "    return {\"effort_limit_sim\": effort, \"velocity_limit_sim\": velocity}\n\n";

/// Isaac Lab 3 has the scalar of a rotation last, Isaac Lab 2 first.
std::string isaaclab_rotation(const Quatd& q) {
  return "(" + tuple_of({q.x, q.y, q.z, q.w}) + " if _IS_3 else " + tuple_of({q.w, q.x, q.y, q.z}) +
         ")";
}

bool is_turned(const Pose& pose) { return !(pose.orientation == kIdentityRotation); }

/// Joints with an actuator of the model, by what their controls are.
std::string mjlab_actuators(const RobotCfg& robot) {
  std::string out;
  for (const bool position : {true, false}) {
    MotorGroup group;
    for (std::size_t i = 0; i < robot.motors.size(); ++i) {
      const JointMotor& motor = robot.motors[i];
      if (motor.driven && !motor.leader && (motor.stiffness != 0) == position) {
        group.motors.push_back(i);
      }
    }
    if (!group.motors.empty()) {
      out += "            XmlActuatorCfg(\n                target_names_expr=(\n" +
             names_list(robot, group, model_name, "                    ") +
             "                ),\n                command_field=\"" +
             (position ? "position" : "velocity") + "\",\n            ),\n";
    }
  }
  return out;
}

}  // namespace

std::string isaaclab_cfg(const RobotCfg& robot) {
  const std::string name = upper(python_name(robot.name));
  std::string out = head(robot, "Isaac Lab's configuration");
  out +=
      "from pathlib import Path\n\nimport isaaclab.sim as sim_utils\n"
      "from isaaclab.actuators import ImplicitActuatorCfg\n"
      "from isaaclab.assets import ArticulationCfg\n";
  out += kIsaacLabVersions;
  out += "\n" + name + "_CFG = ArticulationCfg(\n    spawn=sim_utils.UsdFileCfg(\n" +
         "        usd_path=str(Path(__file__).resolve().parent / " + python_text(robot.file) +
         "),\n";
  if (!robot.variant.empty()) {
    out += "        variants={\"Physics\": " + python_text(robot.variant) + "},\n";
  }
  out += "    ),\n    init_state=ArticulationCfg.InitialStateCfg(\n";
  const Vec3d& p = robot.root.position;
  out += "        pos=" + tuple_of({p[0], p[1], p[2]}) + ",\n";
  out += is_turned(robot.root) ? "        rot=" + isaaclab_rotation(robot.root.orientation) + ",\n"
                               : "";
  out += "        joint_pos={\n" + positions(robot, prim_name, "            ") + "        },\n";
  out += robot.motors.empty() ? "        joint_vel={},\n" : "";
  out += "    ),\n    actuators={\n";
  for (const MotorGroup& group : motor_groups(robot.motors)) {
    out += isaaclab_group(robot, group);
  }
  return out + "    },\n)\n" + pose_lines(robot, prim_name, name);
}

std::string mjlab_cfg(const RobotCfg& robot) {
  const std::string name = upper(python_name(robot.name));
  std::string out = head(robot, "mjlab's configuration");
  const std::string actuators = mjlab_actuators(robot);
  out += "from pathlib import Path\n\nimport mujoco\n";
  out += actuators.empty() ? "" : "from mjlab.actuator import XmlActuatorCfg\n";
  out += "from mjlab.entity import EntityArticulationInfoCfg, EntityCfg\n\n\n";
  out +=
      "def get_spec() -> mujoco.MjSpec:\n    return mujoco.MjSpec.from_file(str("
      "Path(__file__).resolve().parent / " +
      python_text(robot.file) + "))\n\n\n";
  out += name + "_CFG = EntityCfg(\n    spec_fn=get_spec,\n" +
         "    init_state=EntityCfg.InitialStateCfg(\n";
  const Vec3d& p = robot.root.position;
  const Quatd& q = robot.root.orientation;
  out += "        pos=" + tuple_of({p[0], p[1], p[2]}) +
         ",\n        rot=" + tuple_of({q.w, q.x, q.y, q.z}) + ",\n        joint_pos={\n" +
         positions(robot, model_name, "            ") + "        },\n";
  out += robot.motors.empty() ? "        joint_vel={},\n" : "";
  out += "    ),\n    articulation=EntityArticulationInfoCfg(\n        actuators=(" +
         (actuators.empty() ? std::string() : "\n" + actuators + "        ") + "),\n    ),\n)\n";
  return out + pose_lines(robot, model_name, name);
}

}  // namespace tenon
