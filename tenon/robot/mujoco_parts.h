// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tenon/robot/site_sensor.h"

/// What MuJoCo's models have beside the tree, in MuJoCo's words and units (SI, radians).
namespace tenon::robot {

/// A value with a name in MuJoCo's schema: the part after "mjc:" ("option:iterations").
struct MujocoSetting {
  std::string name;
  std::vector<double> numbers;  ///< one for each component; flags 0 or 1
  std::string token;            ///< of settings that are words
};

/// How contacts of a collider are made; none, empty: MuJoCo's default.
struct MujocoContact {
  std::optional<int> condim;     ///< 1, 3, 4 or 6 directions that resist
  std::optional<int> priority;   ///< the collider with the higher one decides about a contact
  std::optional<double> solmix;  ///< weight where priorities are equal
  std::vector<double> solref;    ///< (2)
  std::vector<double> solimp;    ///< (5)
  std::optional<double> margin;  ///< distance at which a contact begins to push [m]
  std::optional<double> gap;     ///< from there to where it is found [m]
};

/// How hard limits and friction of a joint are; empty: MuJoCo's default.
struct MujocoSoftness {
  std::vector<double> solref_limit;     ///< (2)
  std::vector<double> solimp_limit;     ///< (5)
  std::vector<double> solref_friction;  ///< (2)
  std::vector<double> solimp_friction;  ///< (5)
};

/// An actuator that is no spring and damper about a joint.
struct MujocoActuator {
  enum class Target : std::uint8_t { Joint, Tendon };

  std::string name;
  Target kind = Target::Joint;
  std::uint32_t target = 0;      ///< into RobotModel::joints or MujocoParts::tendons
  std::string gain_type;         ///< "fixed", "affine", "muscle", "user"
  std::string bias_type;         ///< "none", "affine", "muscle", "user"
  std::string dyn_type;          ///< "none", "integrator", "filter", "filterexact", ...
  std::vector<double> gain;      ///< (10)
  std::vector<double> bias;      ///< (10)
  std::vector<double> dynamics;  ///< (10)
  std::array<double, 6> gear{1};
  std::optional<std::array<double, 2>> control_range;
  std::optional<std::array<double, 2>> force_range;  ///< [N m or N]
  std::optional<std::array<double, 2>> activation_range;
};

/// What the path of a spatial tendon meets.
struct MujocoTendonWrap {
  enum class Kind : std::uint8_t {
    Site,    ///< goes through a site
    Shape,   ///< goes around a sphere or a cylinder
    Pulley,  ///< ends; what follows is another branch
  };

  Kind kind = Kind::Site;
  std::string name;       ///< of the site, or of the visual or collider
  std::string side_site;  ///< of Shape: where the path goes past; empty: on the shorter way
  double divisor = 1;     ///< of Pulley: of the length of what follows
};

/// A tendon: its length is a sum of joint coordinates, or that of a path.
struct MujocoTendon {
  std::string name;
  std::vector<MujocoTendonWrap> wraps;  ///< of a spatial tendon, which has no joints
  std::vector<std::uint32_t> joints;    ///< (term_count), into RobotModel::joints
  std::vector<double> coefficients;     ///< (term_count)
  double stiffness = 0;
  double damping = 0;
  double friction = 0;
  double armature = 0;
  std::array<double, 2> spring_length{-1, -1};  ///< rest; between the two no force
  std::optional<std::array<double, 2>> range;
  std::vector<MujocoSetting> settings;  ///< others that are not MuJoCo's defaults
};

/// The world that a model brings along, apart from its bodies.
struct MujocoScene {
  std::array<double, 3> gravity{0, 0, -9.81};  ///< [m/s^2]
  double time_step = 0.002;                    ///< [s]
  std::vector<MujocoSetting> settings;         ///< options and flags that are not MuJoCo's defaults
};

/// The shape of a site, in which some sensors look for things.
struct MujocoVolume {
  std::string type;              ///< MuJoCo's word: "sphere", "box"
  std::array<double, 3> size{};  ///< as MuJoCo counts it for the type [m]
};

/// The object of one of MuJoCo's sensors: MuJoCo's word for its kind ("site", "xbody", "geom") and
/// its name in the description. Both empty: nothing.
struct MujocoThing {
  std::string kind;
  std::string name;
};

/// One of MuJoCo's sensors, as it is written.
struct MujocoSensor {
  std::string name;                     ///< empty: none given
  std::string kind;                     ///< the element: "framepos"
  MujocoThing object;                   ///< what is measured
  MujocoThing reference;                ///< in whose frame, or from where
  std::vector<MujocoSetting> settings;  ///< by mjsSensor's names, those that are not its defaults
  /// What measures it in runs: a site with that sensor, or a joint. None, empty: nothing does.
  MujocoThing instrument{};
  SiteSensorKind instrument_kind = SiteSensorKind::Imu;
};

/// A state of the whole model. Positions of hinges and slides count from where the bodies stand as
/// written.
struct MujocoKeyframe {
  std::string name;
  std::vector<double> positions;    ///< qpos (nq)
  std::vector<double> velocities;   ///< qvel (nv)
  std::vector<double> activations;  ///< act (na)
  std::vector<double> controls;     ///< ctrl (nu)
};

/// The whole description as MuJoCo writes it, for the way back.
struct MujocoSource {
  /// It names files by their numbers in `files`, behind the mark ("?0"); empty: none is kept.
  std::string text;
  std::vector<std::string> files;  ///< absolute

  static constexpr char kFileMark = '?';
};

struct MujocoParts {
  std::vector<MujocoActuator> actuators;
  std::vector<MujocoTendon> tendons;
  std::vector<MujocoSensor> sensors;
  std::vector<MujocoKeyframe> keyframes;
  std::optional<MujocoScene> scene;
  MujocoSource source;
};

}  // namespace tenon::robot
