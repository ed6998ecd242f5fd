// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The reverse of convert/shapes/cameras.cpp. A light that no conversion made has no intensity of
// its own that is white: then it is the one that shows white by the same reckoning, at the place of
// the robot for lights that fade. Nothing is brighter than white there.
#include "tenon/describe/cameras.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tenon::describe {
namespace {

constexpr double kTenths = 10;
constexpr double kPi = std::numbers::pi;
constexpr double kNearest = 0.1;  // [m]

double lens_number(const stage::Prim& prim, const char* name, double otherwise) {
  const auto value = prim.attribute(Token(name)).get_as<float>();
  return value ? double{*value} : otherwise;
}

robot::MujocoTracking read_tracking(const stage::Prim& prim, const RobotTree& tree) {
  robot::MujocoTracking tracking;
  const auto mode = prim.attribute("tenon:mujoco:mode").get_as<Token>();
  for (const char* known : {"track", "trackcom", "targetbody", "targetbodycom"}) {
    if (mode && *mode == known) {
      tracking.mode = known;
    }
  }
  const std::vector<Path> targets = prim.relationship("tenon:mujoco:target").targets();
  if (tracking.mode.starts_with("target")) {
    tracking.target = targets.empty() ? std::nullopt : tree.link_at(targets.front());
    tracking.mode = tracking.target ? tracking.mode : "";
  }
  return tracking;
}

std::vector<robot::MujocoSetting> read_settings(const stage::Prim& prim,
                                                std::initializer_list<const char*> names) {
  std::vector<robot::MujocoSetting> settings;
  for (const char* name : names) {
    const auto numbers =
        prim.attribute(Token(std::string("tenon:mujoco:") + name)).get_as<layer::Array<double>>();
    if (numbers && !numbers->empty()) {
      settings.push_back({name, std::vector<double>(numbers->begin(), numbers->end()), ""});
    }
  }
  return settings;
}

/// The intensity that shows a surface as the colour of the light.
double white_of(const stage::Prim& prim, const robot::Light& light, double radius) {
  if (const double own = lens_number(prim, "tenon:mujoco:unitIntensity", 0); own > 0) {
    return own;
  }
  const bool normalized = prim.attribute("inputs:normalize").get_as<bool>().value_or(false);
  if (light.kind == robot::LightKind::Directional) {
    const double half = lens_number(prim, "inputs:angle", 0) / 2 * kPi / 180;
    const double sine = std::sin(half);
    return normalized || sine == 0 ? kPi : 1 / (sine * sine);
  }
  const double reach = light.reach;
  return normalized || radius == 0 ? 4 * kPi * reach * reach : reach * reach / (radius * radius);
}

void set_color(const stage::Prim& prim, double radius, robot::Light& light) {
  const auto color = prim.attribute("inputs:color").get_as<Vec3f>().value_or(Vec3f{{1, 1, 1}});
  const double intensity =
      lens_number(prim, "inputs:intensity", 1) * std::exp2(lens_number(prim, "inputs:exposure", 0));
  const double share = intensity / white_of(prim, light, radius);
  for (std::size_t k = 0; k < 3; ++k) {
    light.color[k] = std::clamp(color[k] * share, 0.0, 1.0);
  }
}

bool is_invisible(const stage::Prim& prim) {
  const auto visibility = prim.attribute("visibility").get_as<Token>();
  return visibility && *visibility == "invisible";
}

}  // namespace

robot::Camera read_camera(SceneSource& source, const stage::Prim& prim, const RobotTree& tree,
                          const Pose& link) {
  const double unit = source.scene().meters_per_unit;
  robot::Camera camera;
  camera.name = prim.path().str();
  camera.pose = inverse(link) * source.placed(prim).pose;
  const auto projection = prim.attribute("projection").get_as<Token>();
  camera.orthographic = projection && *projection == "orthographic";
  const double scale = camera.orthographic ? unit / kTenths : 1;
  camera.aperture = {{lens_number(prim, "horizontalAperture", 0) * scale,
                      lens_number(prim, "verticalAperture", 0) * scale}};
  camera.offset = {{lens_number(prim, "horizontalApertureOffset", 0) * scale,
                    lens_number(prim, "verticalApertureOffset", 0) * scale}};
  camera.focal_length = lens_number(prim, "focalLength", 0);
  camera.tracking = read_tracking(prim, tree);
  camera.settings = read_settings(prim, {"sensorsize", "resolution", "output", "ipd"});
  return camera;
}

std::optional<robot::Light> read_light(SceneSource& source, const stage::Prim& prim,
                                       const RobotTree& tree, const Pose& link) {
  const double unit = source.scene().meters_per_unit;
  robot::Light light;
  light.name = prim.path().str();
  const bool distant = prim.is_a("DistantLight");
  if (!distant && !prim.is_a("SphereLight")) {
    source.left_out(prim.path(), "the light is none that is far away, a ball or a point");
    return std::nullopt;
  }
  const Pose pose = source.placed(prim).pose;
  light.pose = inverse(link) * pose;
  light.reach = std::max(kNearest, length(pose.position));
  if (!distant) {
    const bool is_point = prim.attribute("treatAsPoint").get_as<bool>().value_or(false);
    light.radius = is_point ? 0 : lens_number(prim, "inputs:radius", 0) * unit;
    light.kind = prim.has_api("ShapingAPI") ? robot::LightKind::Spot : robot::LightKind::Point;
  }
  if (light.kind == robot::LightKind::Spot) {
    light.cone = lens_number(prim, "inputs:shaping:cone:angle", light.cone);
    light.softness = lens_number(prim, "inputs:shaping:cone:softness", light.softness);
    light.focus = lens_number(prim, "inputs:shaping:focus", light.focus);
  }
  set_color(prim, light.radius, light);
  light.shadows = prim.attribute("inputs:shadow:enable").get_as<bool>().value_or(true);
  light.is_on = !is_invisible(prim);
  light.tracking = read_tracking(prim, tree);
  light.settings =
      read_settings(prim, {"ambient", "specular", "attenuation", "range", "intensity"});
  return light;
}

}  // namespace tenon::describe
