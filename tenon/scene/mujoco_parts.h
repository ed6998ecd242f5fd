// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/math/transform.h"
#include "tenon/scene/vendor_setting.h"

/// Properties of MuJoCo's schemas without a neutral meaning, for engines that support them.
namespace tenon::scene {

/// What MjcCollisionAPI says of a collider's contacts; none, empty: not authored.
struct MujocoContact {
  std::optional<int> condim;     ///< 1, 3, 4 or 6 directions that resist
  std::optional<int> priority;   ///< the collider with the higher one decides about a contact
  std::optional<double> solmix;  ///< weight where priorities are equal
  std::vector<double> solref;    ///< (2)
  std::vector<double> solimp;    ///< (5)
};

/// What MjcJointAPI says of the constraints of a joint; empty: not authored.
struct MujocoSoftness {
  std::vector<double> solref_limit;     ///< (2)
  std::vector<double> solimp_limit;     ///< (5)
  std::vector<double> solref_friction;  ///< (2)
  std::vector<double> solimp_friction;  ///< (5)
};

/// What MjcEqualityJointAPI says of the constraint of a mimic; empty: not authored.
struct MujocoEquality {
  std::vector<double> solref;  ///< (2)
  std::vector<double> solimp;  ///< (5)
};

/// What MjcEqualityConnectAPI and MjcEqualityWeldAPI say of a joint that closes a loop; empty,
/// none: not authored.
struct MujocoLoop {
  std::vector<double> solref;          ///< (2)
  std::vector<double> solimp;          ///< (5)
  std::optional<double> torque_scale;  ///< of a weld: what rotation weighs [m]
};

/// What the path of a spatial tendon meets.
struct TendonWrap {
  enum class Kind : std::uint8_t {
    Site,      ///< goes through a point
    Sphere,    ///< goes around
    Cylinder,  ///< goes around, along Z and without end
    Pulley,    ///< ends; what follows is another branch
  };
  /// A point of the tendon's surroundings.
  struct Attachment {
    Path path;                          ///< of the prim
    std::optional<std::uint32_t> body;  ///< into PhysicsScene::bodies; none: the world
    Pose pose;                          ///< in the body, or in the world [m]
  };

  Kind kind = Kind::Site;
  Attachment attachment;
  double radius = 0;               ///< [m]
  std::optional<Attachment> side;  ///< where the path goes past a shape; none: on the shorter way
  double divisor = 1;              ///< of Pulley: of the length of what follows
};

/// A tendon (MjcTendon, or of PhysX): its length is the sum of coefficient and coordinate of
/// joints, or that of a path. Numbers are for metres, or for radians where all joints turn.
struct Tendon {
  Path path;
  std::vector<std::uint32_t> joints;  ///< into PhysicsScene::joints
  std::vector<double> coefficients;   ///< (joint_count)
  std::vector<TendonWrap> wraps;      ///< of a spatial tendon, which has no joints
  double stiffness = 0;
  double damping = 0;
  double friction = 0;
  double armature = 0;
  std::array<double, 2> spring_length{-1, -1};  ///< no force between the two; -1: as it stands
  std::optional<std::array<double, 2>> range;
  double limit_stiffness = 0;           ///< of the range as a spring; 0: hard
  std::vector<VendorSetting> settings;  ///< others: limits of force, solver
};

/// A MjcActuator. It pushes with gear * (gain * input + bias), where gain and bias may depend on
/// gear * length of what it acts on, and the input is its control or its activation. SI and
/// radians; what controls are measured in is the actuator's own.
struct MujocoActuator {
  enum class Target : std::uint8_t {
    None,   ///< see `fault`
    Joint,  ///< of one axis, or a ball
    Tendon,
    Site,
    Crank,  ///< a slider crank
  };

  Path path;
  Target kind = Target::None;
  std::uint32_t target = 0;  ///< of Joint, Tendon: into those lists of PhysicsScene
  std::optional<std::uint32_t>
      drive;                    ///< of Joint: the actuator is this one of Joint::drives already
  TendonWrap::Attachment site;  ///< of Site; the pin of Crank
  std::optional<TendonWrap::Attachment>
      other_site;           ///< what Site is seen from; the slider of Crank
  double crank_length = 0;  ///< [m]
  bool in_parent = false;   ///< gear of a ball counts in the parent's frame
  std::string gain_type;    ///< the schema's tokens
  std::string bias_type;
  std::string dyn_type;
  std::array<double, 10> gain{};
  std::array<double, 10> bias{};
  std::array<double, 10> dynamics{};
  std::array<double, 6> gear{1};
  std::optional<std::array<double, 2>> control_range;
  std::optional<std::array<double, 2>> force_range;  ///< [N m or N]
  std::optional<std::array<double, 2>> activation_range;
  std::array<double, 2> length_range{};  ///< both 0: to be found
  double inherit_range = 0;              ///< of the target's range: where controls may be; 0: none
  int activation_count = -1;             ///< -1: as `dyn_type` has it
  bool acts_early = false;               ///< on the activation after a step, not before
  int group = 0;
  std::string fault;  ///< why it acts on nothing; empty: it does
};

}  // namespace tenon::scene
