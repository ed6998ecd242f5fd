// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What MuJoCo says of a camera in angles is a film of USD's usual height at the distance that sees
// this angle. One with a lens of its own has the sizes of that. Lights have the colours
// that they give surfaces; how far a light that does not fade is meant to reach is not said, so it
// is taken to be the middle of the model. What only MuJoCo has a word for is kept as a setting.
#include "tenon/mjcf/seen/cameras.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "tenon/engines/mujoco/model.h"
#include "tenon/math/angle.h"

namespace tenon::mjcf {
namespace {

using engines::mujoco::read_quaternion;
using engines::mujoco::read_vector;

constexpr double kFilmHeight = 15.2908;  // of a camera in USD that says nothing
constexpr double kTenths = 10;           // USD measures films in tenths of its unit
constexpr double kNearest = 0.1;         // reach of lights [m]

std::size_t index(int i) { return static_cast<std::size_t>(i); }

const char* mode_name(int mode) {
  constexpr const char* kNames[] = {"", "track", "trackcom", "targetbody", "targetbodycom"};
  return kNames[std::clamp(mode, 0, 4)];
}

bool looks_at_body(int mode) {
  return mode == mjCAMLIGHT_TARGETBODY || mode == mjCAMLIGHT_TARGETBODYCOM;
}

/// The shortest one from -z.
Quatd turn_from_down(const Vec3d& direction) {
  const Vec3d to = normalized(direction, {{0, 0, -1}});
  constexpr double kOpposite = 1e-12;
  if (1 - to[2] < kOpposite) {
    return {1, 0, 0, 0};
  }
  return normalized(Quatd{to[1], 0 - to[0], 0, 1 - to[2]});
}

template <class T>
void keep(std::vector<robot::MujocoSetting>& settings, const char* name, const T* found,
          const T* usual, std::size_t count) {
  if (!std::equal(found, found + count, usual)) {
    settings.push_back({name, std::vector<double>(found, found + count), ""});
  }
}

class SeenReader {
 public:
  SeenReader(MjcfSource& source, BodyTree& tree)
      : source_(source), model_(source.model()), tree_(tree) {
    for (int body = 0; body < model_.nbody; ++body) {
      const Pose own{read_vector(model_.body_pos + 3 * index(body)),
                     read_quaternion(model_.body_quat + 4 * index(body))};
      start_.push_back(body == 0 ? Pose{} : start_[index(model_.body_parentid[body])] * own);
    }
    find_centers();
    mjs_defaultCamera(&usual_camera_);
    mjs_defaultLight(&usual_light_);
  }

  void run() {
    for (int i = 0; i < model_.ncam; ++i) {
      link(model_.cam_bodyid[i]).cameras.push_back(read_camera(i));
    }
    for (int i = 0; i < model_.nlight; ++i) {
      if (model_.light_type[i] == mjLIGHT_IMAGE) {
        source_.left_out("the light \"" + source_.name(mjOBJ_LIGHT, i, "light") +
                             "\" is an image; it is skipped",
                         source_.line_of(mjOBJ_LIGHT, i));
        continue;
      }
      link(model_.light_bodyid[i]).lights.push_back(read_light(i));
    }
  }

 private:
  robot::Link& link(int body) const { return tree_.links[tree_.link_of_body[index(body)]]; }

  /// Of masses, of each body with all that it carries.
  void find_centers() {
    std::vector<double> masses(start_.size(), 0);
    centers_.resize(start_.size());
    for (std::size_t body = start_.size(); body-- > 0;) {
      masses[body] += model_.body_mass[body];
      centers_[body] += transform_point(start_[body], read_vector(model_.body_ipos + 3 * body)) *
                        model_.body_mass[body];
      if (body > 0) {
        const std::size_t above = index(model_.body_parentid[body]);
        masses[above] += masses[body];
        centers_[above] += centers_[body];
      }
      centers_[body] =
          masses[body] > 0 ? centers_[body] * (1 / masses[body]) : start_[body].position;
    }
  }

  robot::MujocoTracking tracking(int mode, int target) const {
    robot::MujocoTracking result;
    result.mode = mode_name(mode);
    if (looks_at_body(mode) && target >= 0) {
      result.target = tree_.link_of_body[index(target)];
    }
    return result;
  }

  /// What is looked at, from `place`, where the bodies stand as written; in the axes of the world.
  Vec3d look(int mode, int target, const Vec3d& place) const {
    const std::size_t at = index(target);
    return (mode == mjCAMLIGHT_TARGETBODY ? start_[at].position : centers_[at]) - place;
  }

  /// Of a camera that looks at a body: upright, as MuJoCo turns it.
  Quatd turn(int camera) const {
    const std::size_t at = index(camera);
    const int target = model_.cam_targetbodyid[camera];
    if (!looks_at_body(model_.cam_mode[camera]) || target < 0) {
      return read_quaternion(model_.cam_quat + 4 * at);
    }
    const Pose& body = start_[index(model_.cam_bodyid[camera])];
    const Vec3d place = transform_point(body, read_vector(model_.cam_pos + 3 * at));
    const Vec3d z = normalized(look(model_.cam_mode[camera], target, place) * -1.0, {{0, 0, 1}});
    const Vec3d x = normalized(cross({{0, 0, 1}}, z), {{1, 0, 0}});
    const Vec3d y = cross(z, x);
    const Mat3d rows{{{x.v, y.v, z.v}}};
    return conjugate(body.orientation) * rotation_of(rows);
  }

  Vec3d direction(int light) const {
    const std::size_t at = index(light);
    const int mode = model_.light_mode[light];
    const int target = model_.light_targetbodyid[light];
    if (!looks_at_body(mode) || target < 0) {
      return read_vector(model_.light_dir + 3 * at);
    }
    const Pose& body = start_[index(model_.light_bodyid[light])];
    const Vec3d place = transform_point(body, read_vector(model_.light_pos + 3 * at));
    return rotate(conjugate(body.orientation), look(mode, target, place));
  }

  robot::Camera read_camera(int i) const {
    const std::size_t at = index(i);
    robot::Camera camera;
    camera.name = source_.name(mjOBJ_CAMERA, i, "camera");
    camera.pose = {read_vector(model_.cam_pos + 3 * at), turn(i)};
    camera.tracking = tracking(model_.cam_mode[i], model_.cam_targetbodyid[i]);
    camera.orthographic = model_.cam_projection[i] == mjPROJ_ORTHOGRAPHIC;
    const double extent = model_.stat.extent;
    camera.clipping = {model_.vis.map.znear * extent, model_.vis.map.zfar * extent};
    set_film(i, camera);
    keep(camera.settings, "resolution", model_.cam_resolution + 2 * at, usual_camera_.resolution,
         2);
    keep(camera.settings, "output", model_.cam_output + at, &usual_camera_.output, 1);
    keep(camera.settings, "ipd", model_.cam_ipd + at, &usual_camera_.ipd, 1);
    return camera;
  }

  void set_film(int i, robot::Camera& camera) const {
    const std::size_t at = index(i);
    const int* pixels = model_.cam_resolution + 2 * at;
    const double shape = pixels[0] > 1 && pixels[1] > 1 ? double{1} * pixels[0] / pixels[1] : 0;
    const float* film = model_.cam_sensorsize + 2 * at;
    const float* lens = model_.cam_intrinsic + 4 * at;
    if (camera.orthographic) {
      camera.aperture = {{model_.cam_fovy[at] * shape, model_.cam_fovy[at]}};
    } else if (film[0] > 0 && film[1] > 0 && lens[0] > 0 && lens[1] > 0) {
      const double stretch = double{lens[1]} / lens[0];  // one lens for both directions
      camera.aperture = {{kTenths * film[0] * stretch, kTenths * film[1]}};
      camera.offset = {{kTenths * lens[2] * stretch, -kTenths * lens[3]}};  // rows go down
      camera.focal_length = kTenths * lens[1];
      camera.settings.push_back({"sensorsize", {film[0], film[1]}, ""});
    } else {
      camera.aperture = {{kFilmHeight * shape, kFilmHeight}};
      camera.focal_length = kFilmHeight / 2 / std::tan(model_.cam_fovy[at] / 2 / kDegreesPerRadian);
    }
  }

  robot::Light read_light(int i) const {
    const std::size_t at = index(i);
    robot::Light light;
    light.name = source_.name(mjOBJ_LIGHT, i, "light");
    light.pose = {read_vector(model_.light_pos + 3 * at), turn_from_down(direction(i))};
    light.tracking = tracking(model_.light_mode[i], model_.light_targetbodyid[i]);
    light.kind = model_.light_type[i] == mjLIGHT_DIRECTIONAL ? robot::LightKind::Directional
                 : model_.light_type[i] == mjLIGHT_SPOT      ? robot::LightKind::Spot
                                                             : robot::LightKind::Point;
    const float* color = model_.light_diffuse + 3 * at;
    light.color = {{color[0], color[1], color[2]}};
    const Vec3d place = transform_point(start_[index(model_.light_bodyid[i])], light.pose.position);
    light.reach = std::max(kNearest, length(place - read_vector(model_.stat.center)));
    light.radius = model_.light_bulbradius[at];
    light.cone = model_.light_cutoff[at];
    light.softness = model_.light_softness[at];
    light.focus = model_.light_exponent[at];
    light.shadows = model_.light_castshadow[at] != 0;
    light.is_on = model_.light_active[at] != 0;
    keep_settings(at, light.settings);
    return light;
  }

  void keep_settings(std::size_t at, std::vector<robot::MujocoSetting>& settings) const {
    keep(settings, "ambient", model_.light_ambient + 3 * at, usual_light_.ambient, 3);
    keep(settings, "specular", model_.light_specular + 3 * at, usual_light_.specular, 3);
    keep(settings, "attenuation", model_.light_attenuation + 3 * at, usual_light_.attenuation, 3);
    keep(settings, "range", model_.light_range + at, &usual_light_.range, 1);
    keep(settings, "intensity", model_.light_intensity + at, &usual_light_.intensity, 1);
  }

  MjcfSource& source_;
  const mjModel& model_;
  BodyTree& tree_;
  std::vector<Pose> start_;     ///< (nbody) in the world, as written
  std::vector<Vec3d> centers_;  ///< (nbody) in the world
  mjsCamera usual_camera_{};
  mjsLight usual_light_{};
};

}  // namespace

void read_cameras_and_lights(MjcfSource& source, BodyTree& tree) { SeenReader(source, tree).run(); }

}  // namespace tenon::mjcf
