// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// <sensor> below <robot>, as robots that are described for other tools than Gazebo have it: it
// names its link, or the joint that it measures, and its place there.
#include <algorithm>

#include "tenon/urdf/urdf_reader.h"

namespace tenon::urdf {
namespace {

using robot::SiteSensor;
using robot::SiteSensorKind;

std::optional<SiteSensorKind> kind_of_sensor(std::string_view type) {
  if (type == "imu" || type == "accelerometer" || type == "gyroscope") {
    return SiteSensorKind::Imu;
  }
  if (type == "contact") {
    return SiteSensorKind::Contact;
  }
  return type == "force_torque" ? std::optional(SiteSensorKind::ForceTorque) : std::nullopt;
}

/// What the sensor says beside what is taken; with a space before it.
std::string others_of_sensor(pugi::xml_node element) {
  std::string others;
  for (const pugi::xml_node child : element.children()) {
    const std::string_view name = child.name();
    if (child.type() == pugi::node_element && name != "parent" && name != "origin" &&
        name != "always_on") {
      others += (others.empty() ? " without its " : ", ") + std::string(name);
    }
  }
  return others;
}

/// The same instrument at the same place, as <gazebo> may have said before.
bool has_sensor(const robot::Link& link, const robot::Site& wanted) {
  return std::any_of(link.sites.begin(), link.sites.end(), [&](const robot::Site& site) {
    return site.name == wanted.name && site.pose == wanted.pose && !site.sensors.empty() &&
           site.sensors[0].kind == wanted.sensors[0].kind;
  });
}

}  // namespace

void UrdfReader::read_sensor(pugi::xml_node element) {
  const std::string name = element.attribute("name").value();
  const std::string type = element.attribute("type").value();
  const std::string what =
      "holds the sensor \"" + name + "\"" + (type.empty() ? " without a type" : " (" + type + ")");
  const pugi::xml_node parent = element.child("parent");
  const std::optional<SiteSensorKind> kind = kind_of_sensor(type);
  const auto link = links_.find(parent.attribute("link").value());
  const auto joint = joints_.find(parent.attribute("joint").value());
  const bool of_joint = kind == SiteSensorKind::ForceTorque;
  const Result<Pose> pose = xml_.origin(element);
  if (!kind || !pose || (of_joint ? joint == joints_.end() : link == links_.end())) {
    xml_.warn(element, "urdf.extension", what + "; its settings are skipped", "");
    return;
  }
  SiteSensor sensor;
  sensor.name = name;
  sensor.kind = *kind;
  sensor.radius = -1;
  robot::Site site;
  site.name = name.empty() ? "sensor" : name;
  site.pose = *pose;
  site.sensors.push_back(std::move(sensor));
  robot::Link& on = model_.links[of_joint ? model_.joints[joint->second].child : link->second];
  if (!has_sensor(on, site)) {
    on.sites.push_back(std::move(site));
  }
  if (const std::string others = others_of_sensor(element); !others.empty()) {
    xml_.warn(element, "urdf.extension", what + others, "");
  }
}

}  // namespace tenon::urdf
