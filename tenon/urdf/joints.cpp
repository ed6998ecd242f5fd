// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Joints name links, so all links are read before. A mimic may name a joint further down, so mimics
// are read after all joints, from the elements that were kept beside them. An unknown link or type,
// or text in place of a number, ends the reading. Missing bounds, and an effort or velocity of
// zero, count as no limit and are reported; kNoUrdfLimit is how this program writes none.
#include <cmath>

#include "tenon/urdf/plain_urdf.h"
#include "tenon/urdf/urdf_reader.h"

namespace tenon::urdf {
namespace {

using robot::JointKind;

std::optional<JointKind> kind_named(const std::string& type) {
  struct Row {
    const char* type;
    JointKind kind;
  };
  constexpr Row kRows[] = {{"fixed", JointKind::Fixed},
                           {"revolute", JointKind::Revolute},
                           {"continuous", JointKind::Continuous},
                           {"prismatic", JointKind::Prismatic},
                           {"floating", JointKind::Floating},
                           {"planar", JointKind::Planar},
                           {"ball", JointKind::Ball},
                           {"spherical", JointKind::Ball}};
  for (const Row& row : kRows) {
    if (type == row.type) {
      return row.kind;
    }
  }
  return std::nullopt;
}

/// An end as far away as this program writes for none is none.
std::optional<robot::Limit> limit_of_range(double lower, double upper) {
  const auto end = [](double value) {
    return std::fabs(value) >= kNoUrdfLimit ? std::copysign(robot::kUnlimited, value) : value;
  };
  if (lower <= -kNoUrdfLimit && upper >= kNoUrdfLimit) {
    return std::nullopt;
  }
  return robot::Limit{end(lower), end(upper)};
}

Result<void> read_safety(XmlReader& xml, pugi::xml_node element, robot::Joint& joint) {
  const pugi::xml_node safety = element.child("safety_controller");
  if (!safety) {
    return {};
  }
  xml.list_unknown(safety, {"soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity"},
                   {});
  robot::Safety& values = joint.safety.emplace();
  if (safety.attribute("soft_lower_limit")) {
    TENON_TRY(values.soft_lower, xml.number(safety, "soft_lower_limit", std::nullopt));
  }
  if (safety.attribute("soft_upper_limit")) {
    TENON_TRY(values.soft_upper, xml.number(safety, "soft_upper_limit", std::nullopt));
  }
  TENON_TRY(values.position_gain, xml.number(safety, "k_position", 0.0));
  TENON_TRY(values.velocity_gain, xml.number(safety, "k_velocity", 0.0));
  return {};
}

Result<void> read_calibration(XmlReader& xml, pugi::xml_node element, robot::Joint& joint) {
  const pugi::xml_node calibration = element.child("calibration");
  if (!calibration) {
    return {};
  }
  xml.list_unknown(calibration, {"rising", "falling"}, {});
  robot::Calibration& values = joint.calibration.emplace();
  if (calibration.attribute("rising")) {
    TENON_TRY(values.rising, xml.number(calibration, "rising", std::nullopt));
  }
  if (calibration.attribute("falling")) {
    TENON_TRY(values.falling, xml.number(calibration, "falling", std::nullopt));
  }
  return {};
}

}  // namespace

Result<robot::Index> UrdfReader::link_named(pugi::xml_node joint, const char* end) const {
  const pugi::xml_node element = joint.child(end);
  if (!element) {
    return xml_.fault(joint, "urdf.missing", std::string("needs a <") + end + ">",
                      std::string("add <") + end + " link=\"...\"/>");
  }
  TENON_TRY(const std::string name, xml_.text(element, "link"));
  const auto found = links_.find(name);
  if (found == links_.end()) {
    return xml_.fault(element, "urdf.link-missing", "no link is named \"" + name + "\"",
                      "name one of the links");
  }
  return found->second;
}

Result<void> UrdfReader::read_joint(pugi::xml_node element) {
  xml_.list_unknown(element, {"name", "type"},
                    {"origin", "parent", "child", "axis", "limit", "dynamics", "mimic",
                     "safety_controller", "calibration"});
  robot::Joint joint;
  TENON_TRY(joint.name, xml_.text(element, "name"));
  joint.place = xml_.place_of(element);
  TENON_TRY(const std::string type, xml_.text(element, "type"));
  const std::optional<JointKind> kind = kind_named(type);
  if (!kind) {
    return xml_.fault(element, "urdf.joint-type",
                      "the type \"" + type + "\" of joint \"" + joint.name + "\" is not known",
                      "use revolute, continuous, prismatic, fixed, floating or planar");
  }
  joint.kind = *kind;
  TENON_TRY(joint.parent, link_named(element, "parent"));
  TENON_TRY(joint.child, link_named(element, "child"));
  TENON_TRY(joint.origin, xml_.origin(element));
  if (const pugi::xml_node axis = element.child("axis")) {
    xml_.list_unknown(axis, {"xyz"}, {});
    TENON_TRY(const std::vector<double> xyz, xml_.numbers(axis, "xyz", 3, {1, 0, 0}));
    joint.axis = {{xyz[0], xyz[1], xyz[2]}};
  }
  TENON_CHECK(read_limit(element, joint));
  TENON_CHECK(read_dynamics(element, joint));
  TENON_CHECK(read_safety(xml_, element, joint));
  TENON_CHECK(read_calibration(xml_, element, joint));
  joints_.emplace(joint.name, static_cast<robot::Index>(model_.joints.size()));
  joint_elements_.push_back(element);
  model_.joints.push_back(std::move(joint));
  return {};
}

Result<void> UrdfReader::read_limit(pugi::xml_node element, robot::Joint& joint) {
  const pugi::xml_node limit = element.child("limit");
  const bool bounded = joint.kind == JointKind::Revolute || joint.kind == JointKind::Prismatic;
  if (!limit) {
    if (bounded) {
      xml_.warn(element, "urdf.missing",
                "the joint \"" + joint.name + "\" needs a <limit>; it is treated as unlimited",
                "add <limit lower=\"...\" upper=\"...\" effort=\"...\" velocity=\"...\"/>",
                Severity::Error);
    }
    return {};
  }
  xml_.list_unknown(limit, {"lower", "upper", "effort", "velocity"}, {});
  TENON_TRY(const double lower, xml_.number(limit, "lower", 0.0));
  TENON_TRY(const double upper, xml_.number(limit, "upper", 0.0));
  TENON_TRY(const double effort, xml_.number(limit, "effort", robot::kUnlimited));
  TENON_TRY(const double velocity, xml_.number(limit, "velocity", robot::kUnlimited));
  if (bounded && !limit.attribute("lower") && !limit.attribute("upper")) {
    xml_.warn(limit, "urdf.missing",
              "gives the joint \"" + joint.name + "\" no bounds; it is treated as unlimited",
              "write lower and upper, or type=\"continuous\"");
  } else if (bounded) {
    joint.limit = limit_of_range(lower, upper);
  }
  // Many descriptions say 0 where they mean nothing; a joint that cannot move would be fixed.
  if (effort == 0 || velocity == 0) {
    xml_.warn(limit, "urdf.zero-limit",
              std::string(effort == 0 ? "effort" : "velocity") + " 0 of joint \"" + joint.name +
                  "\" is treated as unlimited",
              "give the limit, or leave the attribute out");
  }
  const auto limit_of = [](double value) {
    return value == 0 || value >= kNoUrdfLimit ? robot::kUnlimited : value;
  };
  joint.effort_limit = limit_of(effort);
  joint.velocity_limit = limit_of(velocity);
  return {};
}

Result<void> UrdfReader::read_dynamics(pugi::xml_node element, robot::Joint& joint) {
  const pugi::xml_node dynamics = element.child("dynamics");
  if (!dynamics) {
    return {};
  }
  xml_.list_unknown(dynamics, {"damping", "friction", "armature"}, {});
  TENON_TRY(joint.damping, xml_.number(dynamics, "damping", 0.0));
  TENON_TRY(joint.friction, xml_.number(dynamics, "friction", 0.0));
  TENON_TRY(joint.armature, xml_.number(dynamics, "armature", 0.0));
  return {};
}

Result<void> UrdfReader::read_mimics() {
  for (std::size_t i = 0; i < model_.joints.size(); ++i) {
    const pugi::xml_node mimic = joint_elements_[i].child("mimic");
    if (!mimic) {
      continue;
    }
    xml_.list_unknown(mimic, {"joint", "multiplier", "offset"}, {});
    TENON_TRY(const std::string name, xml_.text(mimic, "joint"));
    const auto leader = joints_.find(name);
    if (leader == joints_.end()) {
      xml_.warn(mimic, "urdf.joint-missing",
                "no joint is named \"" + name + "\"; the mimic of joint \"" +
                    model_.joints[i].name + "\" is skipped",
                "name one of the joints", Severity::Error);
      continue;
    }
    robot::Mimic& values = model_.joints[i].mimic.emplace();
    values.leader = leader->second;
    values.place = xml_.place_of(mimic);
    TENON_TRY(values.multiplier, xml_.number(mimic, "multiplier", 1.0));
    TENON_TRY(values.offset, xml_.number(mimic, "offset", 0.0));
  }
  return {};
}

}  // namespace tenon::urdf
