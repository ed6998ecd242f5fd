// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/converting/patch_seen.h"

#include <string_view>
#include <vector>

#include "tenon/robot/camera_lens.h"

namespace tenon {
namespace {

using Numbers = std::vector<double>;

Numbers list_of(const Vec3d& v) { return {v[0], v[1], v[2]}; }

void set_flag(pugi::xml_node node, const char* attribute, bool value) {
  ModelText::set(node, attribute, value ? "true" : "false");
}

/// What only MuJoCo has a word for; false: it is something else.
bool set_own(const ModelText& text, pugi::xml_node node,
             const std::vector<robot::MujocoSetting>& settings, std::string_view property) {
  constexpr std::string_view kOwn = "tenon:mujoco:";
  for (const robot::MujocoSetting& setting : settings) {
    if (property.starts_with(kOwn) && property.substr(kOwn.size()) == setting.name &&
        setting.name != "output" && setting.name != "sensorsize") {
      text.set_numbers(node, setting.name.c_str(), setting.numbers);
      return true;
    }
  }
  return false;
}

void set_film(const ModelText& text, pugi::xml_node node, const robot::Camera& camera) {
  const Numbers sensor = text.numbers(node, "sensorsize");
  ModelText::set(node, "projection", camera.orthographic ? "orthographic" : "perspective");
  if (camera.orthographic || sensor.size() != 2) {
    text.set_numbers(node, "fovy", {robot::field_of_view(camera)});
    return;
  }
  const robot::Lens lens = robot::lens_of(camera, {{sensor[0], sensor[1]}});
  text.set_numbers(node, "focal", {lens.focal[0], lens.focal[1]});
  text.set_numbers(node, "principal", {lens.principal[0], lens.principal[1]});
}

std::string patch_camera(const ModelText& text, pugi::xml_node node, const robot::Camera& camera,
                         std::string_view property) {
  if (property.starts_with("xformOp")) {
    for (const char* other : {"axisangle", "xyaxes", "zaxis", "euler"}) {
      node.remove_attribute(other);
    }
    const Quatd& turn = camera.pose.orientation;
    text.set_numbers(node, "pos", list_of(camera.pose.position));
    text.set_numbers(node, "quat", {turn.w, turn.x, turn.y, turn.z});
    return {};
  }
  if (property == "projection" || property == "focalLength" ||
      property.starts_with("verticalAperture") || property.starts_with("horizontalAperture")) {
    const bool has_film = !text.value(node, "sensorsize").empty();
    if (!has_film && property.ends_with("Offset")) {
      return "MuJoCo's camera has no film";
    }
    set_film(text, node, camera);
    return {};
  }
  return set_own(text, node, camera.settings, property) ? "" : "it has no attribute of its own";
}

std::string patch_light(const ModelText& text, pugi::xml_node node, const robot::Light& light,
                        std::string_view property) {
  const bool spot = light.kind == robot::LightKind::Spot;
  if (property.starts_with("xformOp")) {
    text.set_numbers(node, "pos", list_of(light.pose.position));
    text.set_numbers(node, "dir", list_of(rotate(light.pose.orientation, {{0, 0, -1}})));
  } else if (property == "inputs:color" || property == "inputs:intensity" ||
             property == "inputs:exposure") {
    text.set_numbers(node, "diffuse", list_of(light.color));
  } else if (property == "inputs:radius") {
    text.set_numbers(node, "bulbradius", {light.radius});
  } else if (property == "inputs:shadow:enable") {
    set_flag(node, "castshadow", light.shadows);
  } else if (property == "visibility") {
    set_flag(node, "active", light.is_on);
  } else if (spot && property == "inputs:shaping:cone:angle") {
    text.set_numbers(node, "cutoff", {light.cone});
  } else if (spot && property == "inputs:shaping:cone:softness") {
    text.set_numbers(node, "softness", {light.softness});
  } else if (spot && property == "inputs:shaping:focus") {
    text.set_numbers(node, "exponent", {light.focus});
  } else if (!set_own(text, node, light.settings, property)) {
    return "it has no attribute of its own";
  }
  return {};
}

template <class Part>
const Part* part_at(const robot::RobotModel& seen, std::vector<Part> robot::Link::* list,
                    const std::string& path) {
  for (const robot::Link& link : seen.links) {
    for (const Part& part : link.*list) {
      if (part.name == path) {
        return &part;
      }
    }
  }
  return nullptr;
}

}  // namespace

std::string patch_seen(ModelText& text, const robot::RobotModel& seen, const PropertyEdit& edit,
                       const std::string& name) {
  const std::string_view whole = edit.property;
  const std::string_view property = whole.substr(whole.find('.') + 1);
  const std::string path = edit.prim.str();
  if (whole.starts_with("Camera.")) {
    const robot::Camera* camera = part_at(seen, &robot::Link::cameras, path);
    const pugi::xml_node node = text.named("camera", name);
    return camera != nullptr && node ? patch_camera(text, node, *camera, property)
                                     : "the model has no camera of its name";
  }
  const robot::Light* light = part_at(seen, &robot::Link::lights, path);
  const pugi::xml_node node = text.named("light", name);
  return light != nullptr && node ? patch_light(text, node, *light, property)
                                  : "the model has no light of its name";
}

}  // namespace tenon
