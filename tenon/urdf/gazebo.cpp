// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What <gazebo reference="..."> says of a link or a joint, as far as assets have a word for it.
// Each child is one setting; those that are not taken are named in one finding for the element.
// Gazebo's cameras look along x with z upwards, those of a model along -z with y upwards.
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "tenon/base/limits/physics_limits.h"
#include "tenon/base/text/text_number.h"
#include "tenon/urdf/gazebo_colors.h"
#include "tenon/urdf/urdf_reader.h"

namespace tenon::urdf {
namespace {

using robot::SiteSensorKind;

/// Of <name>text</name> or <name value="text"/>.
std::string said(pugi::xml_node element) {
  const pugi::xml_attribute value = element.attribute("value");
  std::string text = value ? value.value() : element.text().get();
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  while (!text.empty() && is_space(text.back())) {
    text.pop_back();
  }
  const auto first = std::find_if_not(text.begin(), text.end(), is_space);
  return {first, text.end()};
}

/// Finite, or none.
std::optional<double> number_in(pugi::xml_node element) {
  const auto number = parse_double(said(element));
  return number && std::isfinite(*number) ? number : std::nullopt;
}

bool is_true(pugi::xml_node element) {
  const std::string text = said(element);
  return text == "true" || text == "1" || text == "True";
}

/// Six numbers: place, then roll, pitch, yaw; nothing where they are others.
std::optional<Pose> pose_in(pugi::xml_node element) {
  if (!element) {
    return Pose{};
  }
  std::array<double, 6> numbers{};
  std::string text = said(element);
  std::replace_if(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\t'; }, ' ');
  std::size_t count = 0;
  for (std::size_t at = text.find_first_not_of(' '); at < text.size(); ++count) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const auto number = parse_double(std::string_view(text).substr(at, end - at));
    if (!number || !std::isfinite(*number) || count == numbers.size()) {
      return std::nullopt;
    }
    numbers[count] = *number;
    at = text.find_first_not_of(' ', end);
  }
  if (count != numbers.size()) {
    return std::nullopt;
  }
  const auto& [x, y, z, roll, pitch, yaw] = numbers;
  return Pose{{{x, y, z}}, rotation_of_rpy(roll, pitch, yaw)};
}

/// A camera's axes in those that Gazebo gives it.
constexpr Quatd kCameraAxes{0.5, -0.5, -0.5, 0.5};

std::string name_of_sensor(pugi::xml_node element) {
  const std::string name = element.attribute("name").value();
  return name.empty() ? "sensor" : name;
}

/// Where settings of one element go, and what becomes of them.
struct GazeboSettings {
  robot::Link& link;
  std::size_t& rays;       ///< of the robot
  bool of_joint = false;   ///< the element is of the joint above the link
  std::string without;     ///< parts that are skipped of the last one that was taken
  pugi::xml_node colored;  ///< the one that says a colour
  std::optional<robot::Material> color;
};

/// Contacts as springs: a stiffness above 0, and a damping beside one.
bool take_contact_spring(pugi::xml_node setting, robot::Link& link) {
  const std::optional<double> number = number_in(setting);
  const std::optional<double> stiffness = number_in(setting.parent().child("kp"));
  if (!number || *number < 0 || !stiffness || !(*stiffness > 0) || link.colliders.empty()) {
    return false;
  }
  const bool damps = std::string_view(setting.name()) == "kd";
  for (robot::Collider& collider : link.colliders) {
    (damps ? collider.surface.contact_damping : collider.surface.contact_stiffness) = number;
  }
  return true;
}

/// A setting for all shapes of a link; false: it is something else, or not a number.
bool take_surface(pugi::xml_node setting, robot::Link& link) {
  const std::string_view name = setting.name();
  if (name == "kp" || name == "kd") {
    return take_contact_spring(setting, link);
  }
  const std::optional<double> number = number_in(setting);
  if ((name != "mu1" && name != "mu2" && name != "mu") || !number || *number < 0) {
    return false;
  }
  if (name == "mu2") {  // another friction across is not what assets have
    const auto first = number_in(setting.parent().child("mu1"));
    return first && *first == *number;
  }
  for (robot::Collider& collider : link.colliders) {
    collider.surface.static_friction = number;
    collider.surface.dynamic_friction = number;
  }
  return true;
}

bool take_color(pugi::xml_node setting, GazeboSettings& settings) {
  const std::string name = said(setting);
  const std::optional<Vec4d> color = gazebo_color(name);
  if (!color) {
    return false;
  }
  settings.color.emplace();
  settings.color->name = name.substr(name.find('/') + 1);
  settings.color->color = color;
  settings.colored = setting;
  return true;
}

/// Children of an element that were not taken.
void leave_out_others(pugi::xml_node element, std::initializer_list<std::string_view> taken,
                      GazeboSettings& settings) {
  for (const pugi::xml_node child : element.children()) {
    const std::string_view name = child.name();
    if (child.type() == pugi::node_element &&
        std::find(taken.begin(), taken.end(), name) == taken.end()) {
      settings.without += (settings.without.empty() ? " without its " : ", ") + std::string(name);
    }
  }
}

/// A sensor at a site of its own, which has its name.
void add_site_sensor(pugi::xml_node element, const Pose& pose, robot::SiteSensor sensor,
                     GazeboSettings& settings) {
  robot::Site site;
  site.name = name_of_sensor(element);
  site.pose = pose;
  sensor.name = site.name;
  site.sensors.push_back(std::move(sensor));
  settings.link.sites.push_back(std::move(site));
}

bool take_camera(pugi::xml_node sensor, const Pose& pose, GazeboSettings& settings) {
  const pugi::xml_node described = sensor.child("camera");
  const std::optional<Pose> inner = pose_in(described.child("pose"));
  const double angle = number_in(described.child("horizontal_fov")).value_or(1.047);
  const pugi::xml_node image = described.child("image");
  const double width = number_in(image.child("width")).value_or(320);
  const double height = number_in(image.child("height")).value_or(240);
  if (!described || !inner || !(angle > 0 && angle < std::numbers::pi) || !(width > 0) ||
      !(height > 0)) {
    return false;
  }
  constexpr double kFilmWidth = 20.955;  // of a camera in USD that says nothing
  robot::Camera camera;
  camera.name = name_of_sensor(sensor);
  camera.pose = pose * *inner;
  camera.pose.orientation = camera.pose.orientation * kCameraAxes;
  camera.aperture = {{kFilmWidth, kFilmWidth * height / width}};
  camera.focal_length = kFilmWidth / 2 / std::tan(angle / 2);
  const pugi::xml_node clip = described.child("clip");
  camera.clipping = {number_in(clip.child("near")).value_or(0.1),
                     number_in(clip.child("far")).value_or(100)};
  camera.settings.push_back({"resolution", {std::floor(width), std::floor(height)}, ""});
  settings.link.cameras.push_back(std::move(camera));
  leave_out_others(described, {"pose", "horizontal_fov", "image", "clip"}, settings);
  return true;
}

/// The angles at which rays lie, of <horizontal> or <vertical>; empty where it makes no sense. One
/// ray straight ahead by default.
std::vector<double> scan_angles(pugi::xml_node scan, GazeboSettings& settings) {
  if (!scan) {
    return {0};
  }
  const pugi::xml_node counted = scan.child("samples");
  const double samples = counted ? number_in(counted).value_or(0) : 1;
  const std::optional<double> first = number_in(scan.child("min_angle"));
  const std::optional<double> last = number_in(scan.child("max_angle"));
  if (!(samples >= 1 && samples <= limits::kSensorRays) || !first || !last || *first > *last) {
    return {};
  }
  const bool plain = number_in(scan.child("resolution")).value_or(1) == 1;
  leave_out_others(scan, {"samples", "min_angle", "max_angle", plain ? "resolution" : ""},
                   settings);
  std::vector<double> angles;
  const auto count = static_cast<std::size_t>(samples);
  for (std::size_t i = 0; i < count; ++i) {
    const double share = count > 1 ? static_cast<double>(i) / static_cast<double>(count - 1) : 0;
    angles.push_back(*first + share * (*last - *first));
  }
  return angles;
}

/// A laser scanner, which looks along x with z upwards: rows of rays from the lowest up, each from
/// its least angle about z.
bool take_rays(pugi::xml_node sensor, const Pose& pose, GazeboSettings& settings) {
  pugi::xml_node described = sensor.child("ray");
  described = described ? described : sensor.child("lidar");
  const std::string left_out_before = settings.without;
  const pugi::xml_node scan = described.child("scan");
  const std::vector<double> across = scan_angles(scan.child("horizontal"), settings);
  const std::vector<double> upwards = scan_angles(scan.child("vertical"), settings);
  const pugi::xml_node range = described.child("range");
  const double nearest = number_in(range.child("min")).value_or(0);
  const double farthest = number_in(range.child("max")).value_or(kInfinity);
  if (!scan || across.empty() || upwards.empty() || !(nearest >= 0 && nearest < farthest) ||
      across.size() * upwards.size() > limits::kSensorRays - settings.rays) {
    settings.without = left_out_before;
    return false;
  }
  settings.rays += across.size() * upwards.size();
  leave_out_others(range, {"min", "max"}, settings);
  leave_out_others(described, {"scan", "range"}, settings);
  robot::SiteSensor rays;
  rays.kind = SiteSensorKind::Rays;
  rays.min_range = nearest;
  rays.max_range = farthest;
  const auto clean = [](double part) { return std::fabs(part) < 1e-12 ? 0 : part; };
  for (const double up : upwards) {
    for (const double turn : across) {
      rays.directions.push_back({{clean(std::cos(up) * std::cos(turn)),
                                  clean(std::cos(up) * std::sin(turn)), clean(std::sin(up))}});
    }
  }
  add_site_sensor(sensor, pose, std::move(rays), settings);
  return true;
}

bool is_one_of(std::string_view kind, std::initializer_list<std::string_view> kinds) {
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

/// An instrument at one point; false: of a kind that assets do not support.
bool take_instrument(pugi::xml_node sensor, const Pose& pose, GazeboSettings& settings) {
  const std::string_view kind = sensor.attribute("type").value();
  const bool measures_force = kind == "force_torque";
  if (!is_one_of(kind, {"imu", "contact", "force_torque"}) ||
      (measures_force && !settings.of_joint)) {
    return false;
  }
  robot::SiteSensor measured;
  measured.kind = kind == "imu"       ? SiteSensorKind::Imu
                  : kind == "contact" ? SiteSensorKind::Contact
                                      : SiteSensorKind::ForceTorque;
  measured.radius = -1;
  const double rate = number_in(sensor.child("update_rate")).value_or(0);
  measured.period = rate > 0 && !measures_force ? 1 / rate : 0;
  add_site_sensor(sensor, pose, std::move(measured), settings);
  return true;
}

/// A sensor of a link, or of the joint above it; false: of a kind that assets do not support. All
/// of them measure at all times, which is no setting.
bool take_sensor(pugi::xml_node sensor, GazeboSettings& settings) {
  const std::string_view kind = sensor.attribute("type").value();
  const std::optional<Pose> pose = pose_in(sensor.child("pose"));
  if (!pose) {
    return false;
  }
  if (!settings.of_joint &&
      is_one_of(kind, {"camera", "depth", "depth_camera", "rgbd_camera", "rgbd"})) {
    if (!take_camera(sensor, *pose, settings)) {
      return false;
    }
    leave_out_others(sensor, {"pose", "camera", "always_on"}, settings);
  } else if (!settings.of_joint && is_one_of(kind, {"ray", "gpu_ray", "lidar", "gpu_lidar"})) {
    if (!take_rays(sensor, *pose, settings)) {
      return false;
    }
    leave_out_others(sensor, {"pose", "ray", "lidar", "always_on"}, settings);
  } else {
    if (!take_instrument(sensor, *pose, settings)) {
      return false;
    }
    leave_out_others(sensor, {"pose", kind == "force_torque" ? "" : "update_rate", "always_on"},
                     settings);
  }
  return true;
}

/// false: skipped.
bool take_setting(pugi::xml_node setting, GazeboSettings& settings) {
  const std::string_view name = setting.name();
  if (name == "sensor") {
    return take_sensor(setting, settings);
  }
  if (settings.of_joint) {
    return false;
  }
  if (name == "material") {
    return take_color(setting, settings);
  }
  if (name == "turnGravityOff" || name == "gravity") {
    const bool falls = is_true(setting) == (name == "gravity");
    settings.link.gravity_scale = falls ? 1 : 0;
    return true;
  }
  return take_surface(setting, settings.link);
}

}  // namespace

void UrdfReader::read_gazebo(pugi::xml_node element) {
  const std::string whose = element.attribute("reference").value();
  const auto link = links_.find(whose);
  const auto joint = joints_.find(whose);
  if (link == links_.end() && joint == joints_.end()) {
    xml_.warn(element, "urdf.extension",
              "holds settings for Gazebo" + (whose.empty() ? "" : " (of \"" + whose + "\")") +
                  "; they are skipped",
              "");
    return;
  }
  const bool of_joint = link == links_.end();
  robot::Link& on = model_.links[of_joint ? model_.joints[joint->second].child : link->second];
  GazeboSettings settings{on, rays_, of_joint, {}, {}, {}};
  std::string left;
  for (const pugi::xml_node setting : element.children()) {
    if (setting.type() != pugi::node_element) {
      continue;
    }
    settings.without.clear();
    const bool is_sensor = std::string_view(setting.name()) == "sensor";
    const std::string what = is_sensor ? "sensor \"" + name_of_sensor(setting) + "\" (" +
                                             setting.attribute("type").value() + ")"
                                       : std::string(setting.name());
    if (!take_setting(setting, settings)) {
      left += (left.empty() ? "" : ", ") + what;
    } else if (!settings.without.empty()) {
      left += (left.empty() ? "" : ", ") + what + settings.without;
    }
  }
  const bool wanted = std::any_of(on.visuals.begin(), on.visuals.end(),
                                  [](const robot::Visual& visual) { return !visual.material; });
  if (settings.color && wanted) {  // URDF's own colours count
    settings.color->place = xml_.place_of(settings.colored);
    const robot::Index number = material_number(*std::move(settings.color));
    for (robot::Visual& visual : on.visuals) {
      visual.material = visual.material ? visual.material : number;
    }
  }
  if (!left.empty()) {
    xml_.warn(element, "urdf.extension",
              "holds settings for Gazebo (of \"" + whose + "\") that are skipped: " + left, "");
  }
}

}  // namespace tenon::urdf
