// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// MuJoCo's sensors are single quantities; those of one site are parts of one instrument: what
// accelerates, turns and is oriented is an IMU, force and torque are a force-torque sensor, places
// and velocities in the world those of a frame. A joint is measured as a whole. A touch sensor
// counts contacts in the volume of its site; only a sphere can be expressed elsewhere. A range
// finder is a ray. A quantity of a body, a shape or a camera is measured at a site of its own in
// the asset. Beside that each of MuJoCo's sensors is kept as it is, with its instrument, for models
// that are written of the asset.
#include "tenon/mjcf/sensors/sensors.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tenon/engines/mujoco/build/sensor_fields.h"
#include "tenon/engines/mujoco/model.h"

namespace tenon::mjcf {
namespace {

using engines::mujoco::read_quaternion;
using engines::mujoco::read_vector;
using engines::mujoco::sensor_settings;
using engines::mujoco::sensor_word;
using engines::mujoco::thing_word;
using robot::Index;
using robot::SiteSensorKind;

class SensorList {
 public:
  SensorList(MjcfSource& source, BodyTree& tree)
      : source_(source), model_(source.model()), tree_(tree) {
    std::vector<std::size_t> next(tree.links.size(), 0);
    for (int site = 0; site < model_.nsite; ++site) {
      const Index link = tree.link_of_body[at(model_.site_bodyid[site])];
      sites_.push_back({link, next[link]++});
    }
  }

  std::vector<robot::MujocoSensor> run() {
    for (int i = 0; i < model_.nsensor; ++i) {
      now_ = described(i);
      if (take(i)) {
        tell_settings(i);
      } else {
        tell(i, " measured by nothing in runs");
      }
      kept_.push_back(std::move(now_));
    }
    for (const auto& [how, told] : told_) {
      source_.report(Severity::Info, "mjcf.sensor",
                     std::to_string(told.lines.size()) +
                         (told.lines.size() == 1 ? " sensor is" : " sensors are") +
                         " kept for models of MuJoCo, and" + how + " (" + told.kinds + ")" +
                         lines_text(told.lines),
                     told.lines.front());
    }
    if (touches_) {
      source_.report(Severity::Info, "mjcf.touch",
                     "touch sensors count contacts inside of their sphere; MuJoCo counts those, "
                     "too, whose normal leads through it");
    }
    return std::move(kept_);
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  robot::MujocoSensor described(int sensor) const {
    robot::MujocoSensor result;
    result.name = source_.written_name(mjOBJ_SENSOR, sensor);
    result.kind = sensor_word(static_cast<mjtSensor>(model_.sensor_type[sensor]));
    if (mjsElement* element = source_.element(mjOBJ_SENSOR, sensor)) {
      const mjsSensor* written = mjs_asSensor(element);
      result.object = {thing_word(written->objtype), mjs_getString(written->objname)};
      result.reference = {thing_word(written->reftype), mjs_getString(written->refname)};
      for (const scene::VendorSetting& setting : sensor_settings(*written)) {
        result.settings.push_back({setting.name, setting.numbers, setting.token});
      }
    }
    return result;
  }

  void tell(int sensor, const char* how) {
    Told& told = told_[how];
    const std::string kind = sensor_word(static_cast<mjtSensor>(model_.sensor_type[sensor]));
    if ((", " + told.kinds + ",").find(", " + kind + ",") == std::string::npos) {
      told.kinds += (told.kinds.empty() ? "" : ", ") + kind;
    }
    told.lines.push_back(source_.line_of(mjOBJ_SENSOR, sensor));
  }

  /// Whether it measures something that sites and joints can say.
  bool take(int sensor) {
    const int object = model_.sensor_objid[sensor];
    switch (model_.sensor_type[sensor]) {
      case mjSENS_JOINTPOS:
      case mjSENS_JOINTVEL:
      case mjSENS_BALLQUAT:
      case mjSENS_BALLANGVEL:
        return take_joint(object);
      case mjSENS_JOINTACTFRC:
        return is_driven(object) && take_joint(object);
      case mjSENS_ACTUATORFRC:
        return is_of_joint(object, true) && take_actuator(object);
      case mjSENS_ACTUATORPOS:
      case mjSENS_ACTUATORVEL:
        return is_of_joint(object, false) && take_actuator(object);
      case mjSENS_FRAMEQUAT:
        return take_frame(sensor, is_of_site(sensor) ? SiteSensorKind::Imu : SiteSensorKind::Frame);
      case mjSENS_FRAMELINACC:  // it feels what holds it, as accelerometers do
        return take_frame(sensor, SiteSensorKind::Imu);
      default:
        return is_of_frame(sensor) ? take_frame(sensor, SiteSensorKind::Frame)
                                   : take_instrument(sensor);
    }
  }

  bool is_of_frame(int sensor) const {
    const int kind = model_.sensor_type[sensor];
    return kind == mjSENS_FRAMEPOS || kind == mjSENS_VELOCIMETER ||
           (kind >= mjSENS_FRAMEXAXIS && kind <= mjSENS_FRAMEANGVEL);
  }

  /// What is of sites alone.
  bool take_instrument(int sensor) {
    const int site = model_.sensor_objid[sensor];
    switch (model_.sensor_type[sensor]) {
      case mjSENS_ACCELEROMETER:
      case mjSENS_GYRO:
        return take_site(sensor, SiteSensorKind::Imu);
      case mjSENS_TOUCH:
        return model_.site_type[site] == mjGEOM_SPHERE &&
               take_site(sensor, SiteSensorKind::Contact);
      case mjSENS_FORCE:
      case mjSENS_TORQUE:
        return is_held(model_.site_bodyid[site]) && take_site(sensor, SiteSensorKind::ForceTorque);
      case mjSENS_RANGEFINDER:
        return is_of_site(sensor) && model_.sensor_dim[sensor] == 1 &&
               take_site(sensor, SiteSensorKind::Rays);
      default:
        return false;
    }
  }

  bool is_of_site(int sensor) const { return model_.sensor_objtype[sensor] == mjOBJ_SITE; }

  /// Of a frame in the world; one in another frame has no form.
  bool take_frame(int sensor, SiteSensorKind kind) {
    if (model_.sensor_refid[sensor] >= 0) {
      return false;
    }
    if (is_of_site(sensor)) {
      return model_.site_bodyid[model_.sensor_objid[sensor]] != 0 && take_site(sensor, kind);
    }
    const auto frame = frame_of(model_.sensor_objtype[sensor], at(model_.sensor_objid[sensor]));
    if (!frame || frame->first == 0) {
      return false;
    }
    return take_at(sensor, kind,
                   site_at(sensor, tree_.link_of_body[at(frame->first)], frame->second));
  }

  /// The body that an object belongs to and its place there; none: it has no frame.
  std::optional<std::pair<int, Pose>> frame_of(int kind, std::size_t object) const {
    const auto pose = [&](const mjtNum* position, const mjtNum* rotation) {
      return Pose{read_vector(position + 3 * object), read_quaternion(rotation + 4 * object)};
    };
    switch (kind) {
      case mjOBJ_XBODY:
        return std::pair(static_cast<int>(object), Pose{});
      case mjOBJ_BODY:
        return std::pair(static_cast<int>(object), pose(model_.body_ipos, model_.body_iquat));
      case mjOBJ_GEOM:
        return std::pair(model_.geom_bodyid[object], pose(model_.geom_pos, model_.geom_quat));
      case mjOBJ_CAMERA:
        return std::pair(model_.cam_bodyid[object], pose(model_.cam_pos, model_.cam_quat));
      default:
        return std::nullopt;
    }
  }

  /// The site of a measured object that is not a site itself, made where there is none yet.
  robot::Site& site_at(int sensor, Index link, const Pose& pose) {
    std::vector<robot::Site>& sites = tree_.links[link].sites;
    const auto key = std::pair(model_.sensor_objtype[sensor], model_.sensor_objid[sensor]);
    const auto [known, is_new] = made_.emplace(key, sites.size());
    if (is_new) {
      sites.push_back({source_.name(mjOBJ_SENSOR, sensor, "frame"), pose});
    }
    return sites[known->second];
  }

  bool take_site(int sensor, SiteSensorKind kind) {
    const auto& [link, number] = sites_[at(model_.sensor_objid[sensor])];
    return take_at(sensor, kind, tree_.links[link].sites[number]);
  }

  bool take_at(int sensor, SiteSensorKind kind, robot::Site& site) {
    now_.instrument = {"site", site.name};
    now_.instrument_kind = kind;
    std::vector<robot::SiteSensor>& sensors = site.sensors;
    const auto same = [&](const robot::SiteSensor& other) { return other.kind == kind; };
    if (std::any_of(sensors.begin(), sensors.end(), same)) {
      return true;
    }
    robot::SiteSensor& added = sensors.emplace_back();
    added.name = source_.written_name(mjOBJ_SENSOR, sensor);
    added.kind = kind;
    if (kind == SiteSensorKind::Contact) {
      added.radius = model_.site_size[3 * at(model_.sensor_objid[sensor])];
      touches_ = true;
    }
    if (kind == SiteSensorKind::Rays) {
      added.directions.push_back({{0, 0, 1}});
    }
    return true;
  }

  /// Some joint or weld holds the body to another one: it does not float.
  bool is_held(int body) const {
    const Index link = tree_.link_of_body[at(body)];
    return std::any_of(tree_.joints.begin(), tree_.joints.end(), [&](const robot::Joint& joint) {
      return joint.child == link && joint.kind != robot::JointKind::Floating;
    });
  }

  bool is_driven(int joint) const { return joint_of(joint).drive.has_value(); }
  robot::Joint& joint_of(int joint) const { return tree_.joints[tree_.joint_of_joint[at(joint)]]; }
  bool take_joint(int joint) {
    joint_of(joint).measured = true;
    now_.instrument = {"joint", joint_of(joint).name};
    return true;
  }

  /// One unit of the actuator is one of its joint, which its drive moves where that is asked.
  bool is_of_joint(int actuator, bool driven) const {
    const int joint = model_.actuator_trnid[2 * at(actuator)];
    const bool turns =
        model_.actuator_trntype[actuator] == mjTRN_JOINT &&
        (model_.jnt_type[joint] == mjJNT_HINGE || model_.jnt_type[joint] == mjJNT_SLIDE);
    return turns && (!driven || is_driven(joint)) && model_.actuator_gear[6 * at(actuator)] == 1;
  }
  bool take_actuator(int actuator) { return take_joint(model_.actuator_trnid[2 * at(actuator)]); }

  void tell_settings(int sensor) {
    if (model_.sensor_cutoff[sensor] > 0) {
      tell(sensor, " measured without the cutoff in runs");
    }
    if (model_.sensor_noise[sensor] > 0) {
      tell(sensor, " measured without the noise in runs");
    }
    if (model_.sensor_delay[sensor] > 0 || model_.sensor_interval[2 * at(sensor)] > 0) {
      tell(sensor, " measured without the delay or interval in runs");
    }
  }

  MjcfSource& source_;
  const mjModel& model_;
  BodyTree& tree_;
  struct Told {
    std::string kinds;
    std::vector<std::uint32_t> lines;
  };

  std::vector<std::pair<Index, std::size_t>> sites_;  ///< link and number of each site
  std::map<std::pair<int, int>, std::size_t> made_;   ///< sites of other objects, in their links
  std::map<std::string, Told> told_;                  ///< by what becomes of them
  bool touches_ = false;
  robot::MujocoSensor now_;
  std::vector<robot::MujocoSensor> kept_;
};

}  // namespace

std::vector<robot::MujocoSensor> read_sensors(MjcfSource& source, BodyTree& tree) {
  return SensorList(source, tree).run();
}

}  // namespace tenon::mjcf
