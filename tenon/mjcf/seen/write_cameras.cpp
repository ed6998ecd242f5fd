// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Cameras and lights stand on the bodies of the model, whose frames an engine may have moved. What
// only MuJoCo has a word for comes back from the settings, where it has the right length.
#include "tenon/mjcf/seen/write_cameras.h"

#include <algorithm>
#include <string>
#include <vector>

#include "tenon/base/file_finding.h"
#include "tenon/robot/camera_lens.h"

namespace tenon::mjcf {
namespace {

using engines::mujoco::write_quaternion;
using engines::mujoco::write_vector;

/// The numbers of a setting, as many as there are in both.
template <class T>
bool take(const std::vector<robot::MujocoSetting>& settings, const char* name, T* numbers,
          std::size_t count) {
  for (const robot::MujocoSetting& setting : settings) {
    if (setting.name == name && setting.numbers.size() == count) {
      std::transform(setting.numbers.begin(), setting.numbers.end(), numbers, [](double number) {
        return static_cast<T>(std::clamp(number, -1e9, 1e9));  // whole numbers have an end
      });
      return true;
    }
  }
  return false;
}

mjtCamLight mode_of(const std::string& mode) {
  if (mode == "track") {
    return mjCAMLIGHT_TRACK;
  }
  if (mode == "trackcom") {
    return mjCAMLIGHT_TRACKCOM;
  }
  if (mode == "targetbody") {
    return mjCAMLIGHT_TARGETBODY;
  }
  return mode == "targetbodycom" ? mjCAMLIGHT_TARGETBODYCOM : mjCAMLIGHT_FIXED;
}

class SeenWriter {
 public:
  SeenWriter(const scene::PhysicsScene& scene, const engines::mujoco::Model& model, mjSpec& spec,
             Diagnostics& diagnostics)
      : scene_(scene), model_(model), spec_(spec), diagnostics_(diagnostics) {}

  void run(std::size_t number, const robot::Link& link) {
    mjsBody* body = mjs_findBody(&spec_, body_name(number).c_str());
    if (body == nullptr) {
      return;
    }
    const bool is_body = number < scene_.bodies.size();
    const Pose frame = is_body ? inverse(model_.bodies[number].engine_frame) : Pose{};
    for (const robot::Camera& camera : link.cameras) {
      add_camera(*body, frame, camera);
    }
    for (const robot::Light& light : link.lights) {
      add_light(*body, frame, light);
    }
  }

 private:
  std::string body_name(std::size_t number) const {
    return number < scene_.bodies.size() ? scene_.bodies[number].path.str() : "world";
  }

  template <class Made>
  void set_tracking(const robot::MujocoTracking& tracking, Made& made) const {
    made.mode = mode_of(tracking.mode);
    if (tracking.target) {
      mjs_setString(made.targetbody, body_name(*tracking.target).c_str());
    }
  }

  void add_camera(mjsBody& body, const Pose& frame, const robot::Camera& camera) {
    mjsCamera* made = mjs_addCamera(&body, nullptr);
    mjs_setName(made->element, camera.name.c_str());
    const Pose pose = frame * camera.pose;
    write_vector(made->pos, pose.position);
    write_quaternion(made->quat, normalized(pose.orientation));
    set_tracking(camera.tracking, *made);
    made->proj = camera.orthographic ? mjPROJ_ORTHOGRAPHIC : mjPROJ_PERSPECTIVE;
    take(camera.settings, "resolution", made->resolution, 2);
    take(camera.settings, "output", &made->output, 1);
    take(camera.settings, "ipd", &made->ipd, 1);
    if (camera.orthographic || !set_lens(camera, *made)) {
      made->fovy = robot::field_of_view(camera);
      if (!(camera.offset == Vec2d{})) {
        diagnostics_.add(file_finding(
            Severity::Warning, "mjcf.left-out",
            "the film of camera <" + camera.name + "> is off its middle; the offset is skipped", "",
            0));
      }
    }
  }

  /// Sizes that belong to a film of `sensorsize`; false: the camera has none.
  static bool set_lens(const robot::Camera& camera, mjsCamera& made) {
    if (!take(camera.settings, "sensorsize", made.sensor_size, 2) || !(camera.aperture[0] > 0) ||
        !(camera.aperture[1] > 0)) {
      return false;
    }
    const robot::Lens lens = robot::lens_of(camera, {{made.sensor_size[0], made.sensor_size[1]}});
    for (std::size_t k = 0; k < 2; ++k) {
      made.focal_length[k] = static_cast<float>(lens.focal[k]);
      made.principal_length[k] = static_cast<float>(lens.principal[k]);
    }
    return true;
  }

  void add_light(mjsBody& body, const Pose& frame, const robot::Light& light) {
    mjsLight* made = mjs_addLight(&body, nullptr);
    mjs_setName(made->element, light.name.c_str());
    const Pose pose = frame * light.pose;
    write_vector(made->pos, pose.position);
    write_vector(made->dir, rotate(pose.orientation, {{0, 0, -1}}));
    set_tracking(light.tracking, *made);
    made->type = light.kind == robot::LightKind::Directional ? mjLIGHT_DIRECTIONAL
                 : light.kind == robot::LightKind::Spot      ? mjLIGHT_SPOT
                                                             : mjLIGHT_POINT;
    for (std::size_t k = 0; k < 3; ++k) {
      made->diffuse[k] = static_cast<float>(light.color[k]);
    }
    made->active = light.is_on;
    made->castshadow = light.shadows;
    if (light.kind != robot::LightKind::Directional) {
      made->bulbradius = static_cast<float>(light.radius);
    }
    if (light.kind == robot::LightKind::Spot) {
      made->cutoff = static_cast<float>(light.cone);
      made->softness = static_cast<float>(light.softness);
      made->exponent = static_cast<float>(light.focus);
    }
    take(light.settings, "ambient", made->ambient, 3);
    take(light.settings, "specular", made->specular, 3);
    take(light.settings, "attenuation", made->attenuation, 3);
    take(light.settings, "range", &made->range, 1);
    take(light.settings, "intensity", &made->intensity, 1);
  }

  const scene::PhysicsScene& scene_;
  const engines::mujoco::Model& model_;
  mjSpec& spec_;
  Diagnostics& diagnostics_;
};

}  // namespace

void write_cameras_and_lights(const robot::RobotModel& seen, const scene::PhysicsScene& scene,
                              const engines::mujoco::Model& model, mjSpec& spec,
                              Diagnostics& diagnostics) {
  SeenWriter writer(scene, model, spec, diagnostics);
  for (std::size_t i = 0; i < seen.links.size(); ++i) {
    writer.run(i, seen.links[i]);
  }
}

}  // namespace tenon::mjcf
