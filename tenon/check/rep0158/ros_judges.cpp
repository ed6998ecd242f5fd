// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Section 2: contexts, topics, services, actions and frames of ROS. Nobody registers these schemas,
// so that an attribute is there where it is authored. A value of another type than is asked for
// counts as none in names and roles.
#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "tenon/check/rep0158/judges.h"
#include "tenon/check/simready/reading.h"
#include "tenon/layer/field_values.h"

namespace tenon::check::rep0158 {
namespace {

using simready::text;

constexpr std::array kInterfaces{"RosTopicAPI", "RosServiceAPI", "RosActionAPI"};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Parts of letters, digits and underscores between slashes, none of which begins with a digit.
bool is_ros_name(std::string_view name) {
  name.remove_prefix(name.starts_with('/') ? 1 : 0);
  bool begins = true;
  for (const char c : name) {
    const bool fits = is_letter(c) || (!begins && (is_digit(c) || c == '/'));
    if (!fits) {
      return false;
    }
    begins = c == '/';
  }
  return !begins;
}

bool is_interface(const stage::Prim& prim) {
  return std::any_of(kInterfaces.begin(), kInterfaces.end(),
                     [&](const char* schema) { return names_api(prim, schema); });
}

bool is_below_payload(const stage::Prim& prim) {
  for (stage::Prim at = prim.parent(); at && !at.is_pseudo_root(); at = at.parent()) {
    if (has_payload(at)) {
      return true;
    }
  }
  return false;
}

layer::Value value_of(const stage::Prim& prim, const char* name) {
  return prim.attribute(Token(name)).get();
}

/// Of each prim to which the schema is applied.
template <class Visit>
void each(const Judged& judged, const char* schema, const Visit& visit) {
  for (const stage::Prim& prim : judged.stage.every) {
    if (names_api(prim, schema)) {
      visit(prim);
    }
  }
}

void judge_flag(const Judged& judged, Report& report, const char* schema, const char* name) {
  each(judged, schema, [&](const stage::Prim& prim) {
    if (prim.attribute(Token(name)).is_authored() && !value_of(prim, name).holds<bool>()) {
      report.at(prim, Token(name), std::string(name) + " is no bool", "give true or false");
    }
  });
}

/// A frame's or a topic's name of a frame: a wrong type is an error, a wrong name a warning.
void judge_frame_name(const Judged& judged, Report& report, const char* schema, const char* name) {
  each(judged, schema, [&](const stage::Prim& prim) {
    const layer::Value value = value_of(prim, name);
    if (value.empty()) {
      return;
    }
    const std::string said = text(prim, name);
    const bool is_text = value.holds<std::string>() || value.holds<Token>();
    if (!is_text || (!said.empty() && !is_ros_name(said))) {
      report.at(prim, Token(name),
                std::string(name) + (is_text ? " is \"" + said + "\", no name of ROS"
                                             : std::string(" is no string")),
                "letters, digits and underscores, as in base_link");
      if (!is_text) {
        report.as(Severity::Error);
      }
    }
  });
}

/// Role, name and type of a service or an action.
void judge_call(const Judged& judged, Report& report, const char* schema,
                const std::string& prefix) {
  each(judged, schema, [&](const stage::Prim& prim) {
    for (const char* what : {"role", "name", "type"}) {
      if (text(prim, prefix + what).empty()) {
        report.at(prim, "there is no " + prefix + what, "author it");
      }
    }
    const std::string role = text(prim, prefix + "role");
    if (!role.empty() && role != "server" && role != "client") {
      report.at(prim, Token(prefix + "role"), "the role is \"" + role + "\"",
                "give server or client");
    }
  });
}

}  // namespace

void judge_2_1_1(const Judged& judged, Report& report) {
  each(judged, "RosContextAPI", [&](const stage::Prim& prim) {
    if (is_below_payload(prim)) {
      report.at(prim, "the context is in a payload", "move it above the payload");
    }
  });
}

void judge_2_1_2(const Judged& judged, Report& report) {
  const auto& counted = judged.stage.plain;
  const auto outermost = std::find_if(counted.begin(), counted.end(), [](const stage::Prim& prim) {
    return names_api(prim, "RosContextAPI");
  });
  if (outermost == counted.end()) {
    return;
  }
  each(judged, "RosContextAPI", [&](const stage::Prim& prim) {
    const char* name = "ros:context:parent_frame";
    if (!(prim == *outermost) && !value_of(prim, name).empty()) {
      report.at(prim, Token(name), "a context inside of another one has a parent frame",
                "author it on the outermost context");
    }
  });
}

void judge_2_1_3(const Judged& judged, Report& report) {
  each(judged, "RosContextAPI", [&](const stage::Prim& prim) {
    const std::string said = text(prim, "ros:context:namespace");
    if (!said.empty() && !is_ros_name(said)) {
      report.at(prim, Token("ros:context:namespace"), "\"" + said + "\" is no name of ROS",
                "letters, digits and underscores between slashes, as in robot_1 or /cell/robot_1");
    }
  });
}

void judge_2_2_1(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.every) {
    if (is_interface(prim) && is_below_payload(prim)) {
      report.at(prim, "the interface is in a payload", "move it above the payload");
    }
  }
}

void judge_2_2_2(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.every) {
    if (is_interface(prim) && has_stock_api(prim, "PhysicsRigidBodyAPI")) {
      report.at(prim, "the interface is on a body", "apply it to an Xform below the body");
    }
  }
}

void judge_2_2_3(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.every) {
    const auto count = std::count_if(kInterfaces.begin(), kInterfaces.end(),
                                     [&](const char* schema) { return names_api(prim, schema); });
    if (count > 1) {
      report.at(prim, std::to_string(count) + " interfaces are on one prim",
                "give each its own prim");
    }
  }
}

void judge_2_2_4(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.every) {
    if (!is_interface(prim)) {
      continue;
    }
    stage::Prim body = prim.parent();
    while (body && !has_stock_api(body, "PhysicsRigidBodyAPI")) {
      body = body.parent();
    }
    if (body && (!(prim.parent() == body) || !(prim.type_name() == "Xform"))) {
      report.at(prim, "the interface is below a body, and not on an Xform that is its child",
                "apply it to such an Xform");
    }
  }
}

void judge_2_3_1(const Judged& judged, Report& report) {
  const std::array<std::string, 3> names{"ros:topic:name", "ros:service:name", "ros:action:name"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    each(judged, kInterfaces[i], [&](const stage::Prim& prim) {
      const std::string said = text(prim, names[i]);
      if (!said.empty() && !is_ros_name(said)) {
        report.at(prim, Token(names[i]), "\"" + said + "\" is no name of ROS",
                  "letters, digits and underscores between slashes, as in joint_states");
      }
    });
  }
}

void judge_2_4_1(const Judged& judged, Report& report) {
  each(judged, "RosTopicAPI", [&](const stage::Prim& prim) {
    const std::string role = text(prim, "ros:topic:role");
    if (role != "publisher" && role != "subscription") {
      report.at(prim, Token("ros:topic:role"),
                role.empty() ? "there is no role" : "the role is \"" + role + "\"",
                "give publisher or subscription");
    }
  });
}

void judge_2_4_2(const Judged& judged, Report& report) {
  each(judged, "RosTopicAPI", [&](const stage::Prim& prim) {
    if (text(prim, "ros:topic:name").empty()) {
      report.at(prim, "there is no ros:topic:name", "author it");
    }
  });
}

void judge_2_4_3(const Judged& judged, Report& report) {
  each(judged, "RosTopicAPI", [&](const stage::Prim& prim) {
    if (text(prim, "ros:topic:type").empty()) {
      report.at(prim, "there is no ros:topic:type", "author it, as in sensor_msgs/msg/JointState");
    }
  });
}

void judge_2_4_4(const Judged& judged, Report& report) {
  each(judged, "RosTopicAPI", [&](const stage::Prim& prim) {
    if (text(prim, "ros:topic:role") == "publisher" &&
        value_of(prim, "ros:topic:publish_rate").empty()) {
      report.at(prim, "the publisher has no ros:topic:publish_rate", "author it, in Hz");
    }
  });
}

void judge_2_4_5(const Judged& judged, Report& report) {
  struct Quality {
    const char* name;
    std::array<const char*, 2> values;
  };
  static constexpr std::array<Quality, 3> kQualities{
      {{"ros:topic:qos:reliability", {"reliable", "best_effort"}},
       {"ros:topic:qos:durability", {"transient_local", "volatile"}},
       {"ros:topic:qos:history", {"keep_last", "keep_all"}}}};
  each(judged, "RosTopicAPI", [&](const stage::Prim& prim) {
    for (const Quality& quality : kQualities) {
      if (value_of(prim, quality.name).empty()) {
        continue;
      }
      const std::string said = text(prim, quality.name);
      if (said != "system_default" && said != quality.values[0] && said != quality.values[1]) {
        report.at(
            prim, Token(quality.name), std::string(quality.name) + " is \"" + said + "\"",
            std::string("give system_default, ") + quality.values[0] + " or " + quality.values[1]);
      }
    }
  });
}

void judge_2_4_6(const Judged& judged, Report& report) {
  judge_flag(judged, report, "RosTopicAPI", "ros:topic:starts_enabled");
}

void judge_2_4_7(const Judged& judged, Report& report) {
  judge_frame_name(judged, report, "RosTopicAPI", "ros:topic:override_frame_id");
}

void judge_2_4_8(const Judged& judged, Report& report) {
  const char* name = "ros:topic:qos:match_publisher";
  judge_flag(judged, report, "RosTopicAPI", name);
  each(judged, "RosTopicAPI", [&](const stage::Prim& prim) {
    if (value_of(prim, name).get_or<bool>(false) && text(prim, "ros:topic:role") == "publisher") {
      report.at(prim, Token(name), "a publisher matches publishers", "remove it");
      report.as(Severity::Warning);
    }
  });
}

void judge_2_4_9(const Judged& judged, Report& report) {
  const Token name("ros:topic:qos:depth");
  each(judged, "RosTopicAPI", [&](const stage::Prim& prim) {
    if (!prim.attribute(name).is_authored()) {
      return;
    }
    const std::optional<double> depth = simready::number(prim, name.str());
    const Token type = prim.attribute(name).type_name();
    if (!depth || !(type == "int" || type == "int64" || type == "uint" || type == "uint64" ||
                    type == "uchar")) {
      report.at(prim, name, "the depth is no int", "give an int above 0");
    } else if (*depth <= 0 && text(prim, "ros:topic:qos:history") == "keep_last") {
      report.at(prim, name, "the depth is " + digits(*depth), "give an int above 0");
    }
  });
}

void judge_2_5_1(const Judged& judged, Report& report) {
  judge_call(judged, report, "RosServiceAPI", "ros:service:");
}

void judge_2_5_2(const Judged& judged, Report& report) {
  judge_flag(judged, report, "RosServiceAPI", "ros:service:starts_enabled");
}

void judge_2_6_1(const Judged& judged, Report& report) {
  judge_call(judged, report, "RosActionAPI", "ros:action:");
}

void judge_2_6_2(const Judged& judged, Report& report) {
  judge_flag(judged, report, "RosActionAPI", "ros:action:starts_enabled");
}

void judge_2_7_1(const Judged& judged, Report& report) {
  each(judged, "RosFrameAPI", [&](const stage::Prim& prim) {
    if (has_stock_api(prim, "PhysicsRigidBodyAPI")) {
      report.at(prim, "a body has a frame by itself", "remove RosFrameAPI");
    }
  });
}

void judge_2_7_2(const Judged& judged, Report& report) {
  judge_frame_name(judged, report, "RosFrameAPI", "ros:frame:id");
}

void judge_2_7_3(const Judged& judged, Report& report) {
  judge_flag(judged, report, "RosFrameAPI", "ros:frame:static");
}

void judge_2_8_1(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.every) {
    if (!(prim.type_name() == "Camera")) {
      continue;
    }
    if (names_api(prim, "RosTopicAPI")) {
      report.at(prim, "the topic is on the camera, which looks along -z; ROS looks along z",
                "apply it to an Xform below the camera that is turned by 180 degrees about x");
      continue;
    }
    for (const stage::Prim& child : prim.children()) {
      const std::vector<std::string> ops = xform_ops(child);
      const bool turned = std::any_of(ops.begin(), ops.end(), [](const std::string& op) {
        return op.find("rotatex") != std::string::npos || op.find("orient") != std::string::npos;
      });
      if ((names_api(child, "RosTopicAPI") || names_api(child, "RosFrameAPI")) && !turned &&
          child.is_a(Token("Xformable"))) {
        report.at(child, "the camera looks along -z, ROS along z, and nothing turns the frame",
                  "turn it by 180 degrees about x");
      }
    }
  }
}

void judge_2_9_1(const Judged& judged, Report& report) {
  each(judged, "RosTopicAPI", [&](const stage::Prim& prim) {
    if (text(prim, "ros:topic:name").ends_with("/clock")) {
      report.at(prim, Token("ros:topic:name"), "the topic is the simulator's clock", "remove it");
    }
  });
}

void judge_2_9_2(const Judged& judged, Report& report) {
  for (const auto& [schema, name] : {std::pair{"RosTopicAPI", "ros:topic:type"},
                                     std::pair{"RosServiceAPI", "ros:service:type"}}) {
    each(judged, schema, [&, type = name](const stage::Prim& prim) {
      const std::string said = text(prim, type);
      if (said.starts_with("simulation_interfaces/") ||
          said.starts_with("rosgraph_msgs/msg/Clock")) {
        report.at(prim, Token(type), said + " is the simulator's, not an asset's", "remove it");
      }
    });
  }
}

void judge_2_10_1(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.every) {
    if (has_joint_type(prim) && value_of(prim, "ros:joint:name").empty()) {
      report.at(prim, "the joint has no ros:joint:name; simulators take the prim's name",
                "author it: custom string ros:joint:name = \"" + prim.name().str() + "\"");
    }
  }
}

}  // namespace tenon::check::rep0158
