// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/sensors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tenon::convert {
namespace {

using layer::Value;
using robot::SiteSensor;
using robot::SiteSensorKind;

bool is_force_torque(const SiteSensor& sensor) {
  return sensor.kind == SiteSensorKind::ForceTorque;
}

void mark_sensor(LayerBuilder& builder, Path prim, const char* kind) {
  builder.set_custom(prim, "tenon:sensor", "token", Value(Token(kind)));
}

/// All rays begin at the site.
Path write_rays(RobotLayer& layer, Path site, const SiteSensor& sensor, NameScope& names) {
  const Token type("IsaacRaycastSensor");
  LayerBuilder& builder = layer.builder();
  const Path prim = layer.define(site, names, sensor.name.empty() ? "rays" : sensor.name, type);
  if (std::isfinite(sensor.max_range)) {
    builder.set_number(prim, type, "maxRange", sensor.max_range);
  }
  if (sensor.min_range > 0) {
    builder.set_number(prim, type, "minRange", sensor.min_range);
  }
  std::vector<Vec3f> directions;
  for (const Vec3d& direction : sensor.directions) {
    directions.push_back(to_float(direction + Vec3d{}));
  }
  builder.set_value(prim, type, "numRays",
                    Value(static_cast<std::uint32_t>(sensor.directions.size())));
  builder.set_value(prim, type, "rayOrigins",
                    Value(std::vector<Vec3f>(directions.size(), Vec3f{})));
  builder.set_value(prim, type, "rayDirections", Value(std::move(directions)));
  return prim;
}

Path write_site_sensor(RobotLayer& layer, Path site, const SiteSensor& sensor, NameScope& names) {
  LayerBuilder& builder = layer.builder();
  if (is_force_torque(sensor)) {
    mark_sensor(builder, site, "forceTorque");
    return site;
  }
  if (sensor.kind == SiteSensorKind::Frame) {
    const std::string name = sensor.name.empty() ? "frame" : sensor.name;
    const Path prim = layer.define(site, names, name, "Xform");
    mark_sensor(builder, prim, "frame");
    return prim;
  }
  if (sensor.kind == SiteSensorKind::Rays) {
    return write_rays(layer, site, sensor, names);
  }
  const bool contact = sensor.kind == SiteSensorKind::Contact;
  const Token type(contact ? "IsaacContactSensor" : "IsaacImuSensor");
  const Path prim = layer.define(
      site, names, sensor.name.empty() ? (contact ? "contact" : "imu") : sensor.name, type);
  if (sensor.period > 0) {
    builder.set_number(prim, type, "sensorPeriod", sensor.period);
  }
  if (contact) {
    builder.set_number(prim, type, "radius", sensor.radius);
    builder.set_value(prim, type, "threshold",
                      Value(Vec2f{{0, std::numeric_limits<float>::infinity()}}));
  }
  return prim;
}

}  // namespace

void drop_merged_sensors(robot::RobotModel& model, Diagnostics& diagnostics) {
  for (const robot::Joint& joint : model.joints) {
    if (joint.kind != robot::JointKind::Fixed) {
      continue;
    }
    robot::Link& link = model.links[joint.child];
    for (robot::Site& site : link.sites) {
      if (std::erase_if(site.sensors, is_force_torque) > 0) {
        diagnostics.add(robot::model_finding(
            model, link.place, Severity::Warning, "convert.sensor",
            "the force-torque sensor at \"" + site.name + "\" is skipped: its link is merged",
            "convert without merging links that are fixed"));
      }
    }
  }
}

InstrumentPrims write_sensors(const Source& source, const LinkPrims& links,
                              const JointPrims& joints, const ShapePrims& shapes,
                              RobotLayer& layer) {
  InstrumentPrims instruments;
  for (robot::Index i = 0; i < source.model.links.size(); ++i) {
    for (const robot::Site& site : source.model.links[i].sites) {
      const auto prim = shapes.sites.find(site.name);
      if (site.sensors.empty() || prim == shapes.sites.end()) {
        continue;
      }
      NameScope names;
      for (const SiteSensor& sensor : site.sensors) {
        if (is_force_torque(sensor) && links[i].role == LinkRole::Frame) {
          layer.report(source.model.links[i].place, Severity::Warning, "convert.sensor",
                       "the force-torque sensor at \"" + site.name +
                           "\" is skipped: its link has no mass and is a part of another",
                       "give the link a mass");
          continue;
        }
        instruments.emplace(std::pair(site.name, sensor.kind),
                            write_site_sensor(layer, prim->second, sensor, names));
      }
    }
  }
  for (robot::Index j = 0; j < source.model.joints.size(); ++j) {
    if (source.model.joints[j].measured && !joints.joints[j].empty()) {
      mark_sensor(layer.builder(), joints.joints[j], "joint");
    }
  }
  return instruments;
}

}  // namespace tenon::convert
