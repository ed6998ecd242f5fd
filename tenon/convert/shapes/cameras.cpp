// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Units of light. A white surface (Lambert) that gets the illuminance E shows E / pi. With
// inputs:normalize, the illuminance of a distant light is its intensity, so pi shows white. That of
// a ball of radius r is L pi r^2 / d^2 at the distance d, its luminance L being intensity / (4 pi
// r^2): a quarter of the intensity by d^2, so 4 pi d^2 shows white there (UsdLux, LightAPI).
#include "tenon/convert/shapes/cameras.h"

#include <numbers>

namespace tenon::convert {
namespace {

using layer::Value;
using robot::LightKind;

constexpr double kTenths = 10;  // USD measures films in tenths of its unit
constexpr double kPi = std::numbers::pi;

Token mujoco_name(const std::string& word) { return Token("tenon:mujoco:" + word); }

void write_own(RobotLayer& layer, const LinkPrims& links, Path prim,
               const robot::MujocoTracking& tracking,
               const std::vector<robot::MujocoSetting>& settings) {
  if (!tracking.mode.empty()) {
    layer.builder().set_custom(prim, mujoco_name("mode"), "token", Value(Token(tracking.mode)));
  }
  if (tracking.target) {
    layer.builder().set_relationship(prim, mujoco_name("target"), {links[*tracking.target].path});
  }
  for (const robot::MujocoSetting& setting : settings) {
    layer.builder().set_custom(prim, mujoco_name(setting.name), "double[]",
                               Value(layer::Array<double>(setting.numbers)));
  }
}

void set_float2(RobotLayer& layer, Path prim, const char* property, double x, double y) {
  layer.builder().set_value(prim, "Camera", property,
                            Value(Vec2f{{static_cast<float>(x), static_cast<float>(y)}}));
}

void write_shape(LayerBuilder& builder, Path prim, const robot::Light& light) {
  builder.apply(prim, "ShapingAPI");
  builder.set_number(prim, "ShapingAPI", "inputs:shaping:cone:angle", light.cone);
  builder.set_number(prim, "ShapingAPI", "inputs:shaping:cone:softness", light.softness);
  builder.set_number(prim, "ShapingAPI", "inputs:shaping:focus", light.focus);
}

void write_ball(LayerBuilder& builder, Path prim, const robot::Light& light) {
  if (light.radius > 0) {
    builder.set_number(prim, "SphereLight", "inputs:radius", light.radius);
  } else {
    builder.set_value(prim, "SphereLight", "treatAsPoint", Value(true));
  }
  if (light.kind == LightKind::Spot) {
    write_shape(builder, prim, light);
  }
}

}  // namespace

Path write_camera(RobotLayer& layer, const LinkPrims& links, Path link, NameScope& names,
                  const robot::Camera& camera) {
  const Path prim =
      layer.define(link, names, camera.name.empty() ? "camera" : camera.name, "Camera");
  LayerBuilder& builder = layer.builder();
  layer.set_pose(prim, camera.pose);
  const double unit = camera.orthographic ? kTenths : 1;
  if (camera.orthographic) {
    builder.set_value(prim, "Camera", "projection", Value(Token("orthographic")));
  } else {
    builder.set_number(prim, "Camera", "focalLength", camera.focal_length);
  }
  builder.set_number(prim, "Camera", "verticalAperture", camera.aperture[1] * unit);
  if (camera.aperture[0] > 0) {
    builder.set_number(prim, "Camera", "horizontalAperture", camera.aperture[0] * unit);
  }
  if (!(camera.offset == Vec2d{})) {
    builder.set_number(prim, "Camera", "horizontalApertureOffset", camera.offset[0] * unit);
    builder.set_number(prim, "Camera", "verticalApertureOffset", camera.offset[1] * unit);
  }
  if (camera.clipping[1] > camera.clipping[0]) {
    set_float2(layer, prim, "clippingRange", camera.clipping[0], camera.clipping[1]);
  }
  write_own(layer, links, prim, camera.tracking, camera.settings);
  return prim;
}

void write_light(RobotLayer& layer, const LinkPrims& links, Path link, NameScope& names,
                 const robot::Light& light) {
  const bool distant = light.kind == LightKind::Directional;
  const Token type(distant ? "DistantLight" : "SphereLight");
  const Path prim = layer.define(link, names, light.name.empty() ? "light" : light.name, type);
  LayerBuilder& builder = layer.builder();
  layer.set_pose(prim, light.pose);
  const double white = distant ? kPi : 4 * kPi * light.reach * light.reach;
  builder.set_value(prim, type, "inputs:color", Value(to_float(light.color)));
  builder.set_number(prim, type, "inputs:intensity", white);
  builder.set_value(prim, type, "inputs:normalize", Value(true));
  if (!distant) {
    write_ball(builder, prim, light);
  }
  if (!light.shadows) {
    builder.apply(prim, "ShadowAPI");
    builder.set_value(prim, "ShadowAPI", "inputs:shadow:enable", Value(false));
  }
  if (!light.is_on) {
    builder.set_attribute(prim, "visibility", "token", Value(Token("invisible")));
  }
  builder.set_custom(prim, mujoco_name("unitIntensity"), "float", Value(static_cast<float>(white)));
  write_own(layer, links, prim, light.tracking, light.settings);
}

}  // namespace tenon::convert
