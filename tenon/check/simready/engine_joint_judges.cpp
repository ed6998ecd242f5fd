// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Requirements on joints, drives and articulations by Newton's and MuJoCo's schemas. Numbers are
// judged where they are authored: what an engine takes where a file says nothing is its own matter.
#include <cmath>
#include <set>

#include "tenon/check/simready/judges.h"
#include "tenon/check/simready/reading.h"
#include "tenon/layer/field_values.h"

namespace tenon::check::simready {

void judge_newton_ba_001(const Judged& judged, Report& report) {
  static const std::string kSwitch = "newton:selfCollisionEnabled";
  std::vector<stage::Prim> roots;
  for (const stage::Prim& prim : judged.stage.plain) {
    const bool root = has_api(prim, "PhysicsArticulationRootAPI");
    if (root) {
      roots.push_back(prim);
    } else if (has_api(prim, "NewtonArticulationRootAPI") || is_authored(prim, kSwitch)) {
      report.at(prim, "Newton's settings of an articulation on what is no root of one",
                "move them to the prim with PhysicsArticulationRootAPI");
    }
  }
  if (roots.size() != 1) {
    report.at_root(judged, std::to_string(roots.size()) + " prims are roots of articulations",
                   "apply PhysicsArticulationRootAPI to one");
  } else if (!is_authored(roots.front(), kSwitch) ||
             !roots.front().attribute(Token(kSwitch)).get().holds<bool>()) {
    report.at(roots.front(), kSwitch + " does not say whether links touch each other",
              "author true or false");
  }
}

namespace {

void judge_newton_actuator(const stage::Prim& actuator, Report& report) {
  const stage::Prim joint = target_prim(actuator, "newton:targets");
  if (!joint || !(is_revolute(joint) || is_prismatic(joint))) {
    report.at(actuator, "the actuator moves no revolute or prismatic joint",
              "name one in newton:targets");
  }
  bool controlled = false;
  for (const char* api : {"NewtonActuatorControlBaseAPI", "NewtonPDControlAPI",
                          "NewtonPIDControlAPI", "NewtonNeuralControlAPI"}) {
    controlled = controlled || has_api(actuator, api);
  }
  if (!controlled) {
    report.at(actuator, "the actuator has no control law", "apply NewtonPDControlAPI");
  }
  for (const char* name :
       {"newton:kp", "newton:kd", "newton:ki", "newton:integralMax", "newton:maxEffort",
        "newton:maxMotorEffort", "newton:saturationEffort"}) {
    if (is_authored(actuator, name) && !is_good_number(number(actuator, name), 0)) {
      report.at(actuator, Token(name), "no number of at least 0", "correct it");
    }
  }
  const auto effort = number(actuator, "newton:constEffort");
  if (is_authored(actuator, "newton:constEffort") && !(effort && std::isfinite(*effort))) {
    report.at(actuator, Token("newton:constEffort"), "no finite number", "correct it");
  }
  const layer::Value delay = actuator.attribute(Token("newton:delaySteps")).get();
  if (is_authored(actuator, "newton:delaySteps") && delay.get_or(std::int32_t{-1}) < 0) {
    report.at(actuator, Token("newton:delaySteps"), "no count of steps", "give 0 or more");
  }
}

bool follows_by_newton(const stage::Prim& joint) {
  return has_api(joint, "NewtonMimicAPI") && flag(joint, "newton:mimicEnabled", true) &&
         !targets(joint, "newton:mimicJoint").empty();
}

void judge_newton_drive(const stage::Prim& joint, const std::string& axis, Report& report) {
  const std::string force = drive_name(axis, "maxForce");
  const auto most = authored_number_of(joint, force);
  if (!most || !std::isfinite(*most) || !(*most > 0)) {
    report.at(joint, Token(force), "the drive has no effort above 0 that is finite",
              "author " + force);
  }
  for (const char* gain : {"stiffness", "damping"}) {
    const std::string name = drive_name(axis, gain);
    if (is_authored(joint, name) && !is_good_number(number(joint, name), 0)) {
      report.at(joint, Token(name), "no number of at least 0", "correct it");
    }
  }
  for (const char* target : {"targetPosition", "targetVelocity"}) {
    const std::string name = drive_name(axis, target);
    const auto value = number(joint, name);
    if (is_authored(joint, name) && !(value && std::isfinite(*value))) {
      report.at(joint, Token(name), "no finite number", "correct it");
    }
  }
}

}  // namespace

void judge_newton_dj_001(const Judged& judged, Report& report) {
  std::set<Path> actuated;
  for (const stage::Prim& prim : judged.stage.plain) {
    if (prim.type_name() == "NewtonActuator") {
      const std::vector<Path> found = targets(prim, "newton:targets");
      actuated.insert(found.begin(), found.end());
    }
  }
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (prim.type_name() == "NewtonActuator") {
      judge_newton_actuator(prim, report);
    }
    if (!is_moving_joint(prim)) {
      continue;
    }
    std::vector<std::string> axes = driven_axes(prim);
    if (!is_revolute(prim) && !is_prismatic(prim)) {
      for (const char* axis : {"angular", "linear"}) {
        if (has_api(prim, std::string("PhysicsDriveAPI:") + axis)) {
          axes.emplace_back(axis);
        }
      }
    }
    if (axes.empty() && is_articulated(prim) && !actuated.contains(prim.path()) &&
        !follows_by_newton(prim)) {
      report.at(prim, "nothing drives the joint and it follows none",
                "apply PhysicsDriveAPI or NewtonMimicAPI, or add a NewtonActuator");
    }
    for (const std::string& axis : axes) {
      judge_newton_drive(prim, axis, report);
    }
  }
}

void judge_newton_dj_002(const Judged& judged, Report& report) {
  static const std::vector<std::string> kPlain{"newton:armature", "newton:damping",
                                               "newton:friction"};
  static const std::vector<std::string> kSprings{"newton:limitStiffness", "newton:limitDamping"};
  static const std::string kVelocity = "newton:velocityLimit";
  for (const stage::Prim& prim : judged.stage.with_shared) {
    const bool joint = is_joint(prim);
    if (!joint && has_any_api(prim, "NewtonJointAPI")) {
      report.at(prim, "NewtonJointAPI on what is no joint", "remove it");
    }
    const auto check = [&](const std::string& name, bool good) {
      if (is_authored(prim, name) && (!joint || !good)) {
        report.at(prim, Token(name), joint ? "no usable number" : "on what is no joint",
                  joint ? "give a number of at least 0" : "remove it");
      }
    };
    for (const std::string& name : kPlain) {
      check(name, is_good_number(number(prim, name), 0));
    }
    for (const std::string& name : kSprings) {
      const auto value = number(prim, name);
      check(name, value && (std::isinf(*value) || *value >= 0));
    }
    const auto velocity = number(prim, kVelocity);
    check(kVelocity, velocity && *velocity >= 0);
  }
}

void judge_newton_dj_003(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (!has_api(prim, "NewtonMimicAPI")) {
      continue;
    }
    if (!is_joint(prim)) {
      report.at(prim, "NewtonMimicAPI on what is no joint", "remove it");
      continue;
    }
    const std::vector<Path> leaders = targets(prim, "newton:mimicJoint");
    const stage::Prim leader = target_prim(prim, "newton:mimicJoint");
    if (leaders.size() != 1 || leader == prim || !is_joint(leader)) {
      report.at(prim, "newton:mimicJoint names no other joint", "name the one that it follows");
    }
    for (const char* name : {"newton:mimicCoef0", "newton:mimicCoef1"}) {
      const auto value = number(prim, name);
      if (is_authored(prim, name) && !(value && std::isfinite(*value))) {
        report.at(prim, Token(name), "no finite number", "correct it");
      }
    }
    if (is_authored(prim, "newton:mimicEnabled") &&
        !prim.attribute(Token("newton:mimicEnabled")).get().holds<bool>()) {
      report.at(prim, Token("newton:mimicEnabled"), "no bool", "give true or false");
    }
  }
}

void judge_mujoco_ba_001(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (has_api(prim, "MjcArticulationRootAPI") || prim.type_name() == "MjcArticulationRoot") {
      report.at(prim, "a root of an articulation by a schema that MuJoCo does not have",
                "apply PhysicsArticulationRootAPI");
    }
  }
}

void judge_mujoco_dj_001(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    const bool has = has_api(prim, "MjcJointAPI");
    const bool armature = is_authored(prim, "mjc:armature");
    if ((has || armature) && !is_joint(prim)) {
      report.at(prim, "MuJoCo's values of a joint on what is none", "remove them");
    } else if (is_articulated(prim) && !has) {
      report.at(prim, "the joint has no MjcJointAPI", "apply it");
    } else if (has && armature && !is_good_number(number(prim, "mjc:armature"), 0)) {
      report.at(prim, Token("mjc:armature"), "no number of at least 0", "correct it");
    }
  }
}

namespace {

/// "" where the numbers of an actuator are right.
std::string fault_of_actuator(const stage::Prim& actuator) {
  for (const char* range : {"mjc:ctrlRange:", "mjc:forceRange:"}) {
    const std::string low_name = std::string(range) + "min";
    const std::string high_name = std::string(range) + "max";
    const auto low = authored_number_of(actuator, low_name);
    const auto high = authored_number_of(actuator, high_name);
    if (is_authored(actuator, low_name) != is_authored(actuator, high_name)) {
      return std::string(range) + "min and max are not both authored";
    }
    if (is_authored(actuator, low_name) &&
        !(low && high && std::isfinite(*low) && std::isfinite(*high) && *low <= *high)) {
      return std::string(range) + "min and max are no range";
    }
  }
  for (const char* name : {"mjc:gainPrm", "mjc:biasPrm"}) {
    if (is_authored(actuator, name) && !holds_numbers(actuator.attribute(Token(name)).get())) {
      return std::string(name) + " holds no numbers";
    }
  }
  const bool empty =
      is_authored(actuator, "mjc:biasType") && text(actuator, "mjc:biasType").empty();
  return empty ? "mjc:biasType is empty" : "";
}

}  // namespace

void judge_mujoco_dj_002(const Judged& judged, Report& report) {
  std::vector<stage::Prim> joints;
  std::vector<stage::Prim> actuators;
  for (const stage::Prim& prim : judged.stage.plain) {
    if (is_articulated(prim) && has_api(prim, "MjcJointAPI")) {
      joints.push_back(prim);
    }
    if (prim.type_name() == "MjcActuator") {
      actuators.push_back(prim);
    }
  }
  std::set<Path> moved;
  for (const stage::Prim& actuator : actuators) {
    const stage::Prim joint = target_prim(actuator, "mjc:target");
    if (targets(actuator, "mjc:target").size() != 1 || !joint || !is_articulated(joint) ||
        !has_api(joint, "MjcJointAPI")) {
      report.at(actuator, "the actuator moves no joint with MjcJointAPI", "name one in mjc:target");
      continue;
    }
    moved.insert(joint.path());
    const std::string fault = fault_of_actuator(actuator);
    if (!fault.empty()) {
      report.at(actuator, fault, "correct the actuator");
    }
  }
  for (const stage::Prim& joint : joints) {
    if (!moved.contains(joint.path())) {
      report.at(joint, "no MjcActuator moves the joint", "add one with mjc:target");
    }
  }
}

}  // namespace tenon::check::simready
