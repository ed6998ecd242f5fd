// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// MuJoCo's sensors are single quantities; those of one site are parts of one instrument: what
// accelerates, turns and is oriented is an IMU, force and torque are a force-torque sensor. A joint
// is measured as a whole. A touch sensor counts contacts in the volume of its site, of which a
// sphere is the one that can be said elsewhere.
#include "tenon/mjcf/sensors/sensors.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace tenon::mjcf {
namespace {

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

  void run() {
    for (int i = 0; i < model_.nsensor; ++i) {
      if (take(i)) {
        tell_settings(i);
      } else {
        leave_out(i);
      }
    }
    for (const auto& [why, lines] : left_out_) {
      source_.left_out(std::to_string(lines.size()) + (lines.size() == 1 ? " sensor" : " sensors") +
                           why + lines_text(lines),
                       lines.front());
    }
    if (touches_) {
      source_.report(Severity::Info, "mjcf.touch",
                     "touch sensors count contacts inside of their sphere; MuJoCo counts those, "
                     "too, whose normal leads through it");
    }
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  void leave_out(int sensor, const char* what = " left out, which have no form in USD") {
    left_out_[what].push_back(source_.line_of(mjOBJ_SENSOR, sensor));
  }

  /// Whether it measures something that sites and joints can say.
  bool take(int sensor) {
    switch (model_.sensor_type[sensor]) {
      case mjSENS_ACCELEROMETER:
      case mjSENS_GYRO:
        return take_site(sensor, SiteSensorKind::Imu);
      case mjSENS_FRAMEQUAT:
        return model_.sensor_objtype[sensor] == mjOBJ_SITE && model_.sensor_refid[sensor] < 0 &&
               take_site(sensor, SiteSensorKind::Imu);
      case mjSENS_TOUCH:
        return model_.site_type[model_.sensor_objid[sensor]] == mjGEOM_SPHERE &&
               take_site(sensor, SiteSensorKind::Contact);
      case mjSENS_FORCE:
      case mjSENS_TORQUE:
        return is_held(model_.site_bodyid[model_.sensor_objid[sensor]]) &&
               take_site(sensor, SiteSensorKind::ForceTorque);
      case mjSENS_JOINTPOS:
      case mjSENS_JOINTVEL:
        return take_joint(model_.sensor_objid[sensor]);
      case mjSENS_JOINTACTFRC:
        return is_driven(model_.sensor_objid[sensor]) && take_joint(model_.sensor_objid[sensor]);
      case mjSENS_ACTUATORFRC:
        return take_actuator(model_.sensor_objid[sensor]);
      default:
        return false;
    }
  }

  bool take_site(int sensor, SiteSensorKind kind) {
    const int site = model_.sensor_objid[sensor];
    const auto& [link, number] = sites_[at(site)];
    std::vector<robot::SiteSensor>& sensors = tree_.links[link].sites[number].sensors;
    const auto same = [&](const robot::SiteSensor& other) { return other.kind == kind; };
    if (std::any_of(sensors.begin(), sensors.end(), same)) {
      return true;
    }
    robot::SiteSensor& added = sensors.emplace_back();
    added.name = source_.written_name(mjOBJ_SENSOR, sensor);
    added.kind = kind;
    if (kind == SiteSensorKind::Contact) {
      added.radius = model_.site_size[3 * at(site)];
      touches_ = true;
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
    return true;
  }

  /// Its force is that of the joint's drive where one unit of it is one of the joint.
  bool take_actuator(int actuator) {
    const int joint = model_.actuator_trnid[2 * at(actuator)];
    return model_.actuator_trntype[actuator] == mjTRN_JOINT && is_driven(joint) &&
           model_.actuator_gear[6 * at(actuator)] == 1 && take_joint(joint);
  }

  void tell_settings(int sensor) {
    if (model_.sensor_cutoff[sensor] > 0) {
      leave_out(sensor, " without the cutoff");
    }
    if (model_.sensor_noise[sensor] > 0) {
      leave_out(sensor, " without the noise");
    }
    if (model_.sensor_delay[sensor] > 0 || model_.sensor_interval[2 * at(sensor)] > 0) {
      leave_out(sensor, " without the delay or interval");
    }
  }

  MjcfSource& source_;
  const mjModel& model_;
  BodyTree& tree_;
  std::vector<std::pair<Index, std::size_t>> sites_;            ///< link and number of each site
  std::map<std::string, std::vector<std::uint32_t>> left_out_;  ///< lines, by what becomes of them
  bool touches_ = false;
};

}  // namespace

void read_sensors(MjcfSource& source, BodyTree& tree) { SensorList(source, tree).run(); }

}  // namespace tenon::mjcf
