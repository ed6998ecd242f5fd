// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/scene/mujoco_parts.h"
#include "tenon/scene/physics_scene.h"

/// MuJoCo's actuators and keyframes as their schemas have them: for those who write models.
namespace tenon::scene {

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
  Index target = 0;             ///< of Joint, Tendon: into those lists of PhysicsScene
  std::optional<Index> drive;   ///< of Joint: the actuator is this one of Joint::drives already
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

/// A MjcKeyframe: a state in the order and the units of the asset. Lists that are not authored are
/// empty.
struct MujocoKeyframe {
  Path path;
  std::vector<double> positions;
  std::vector<double> velocities;
  std::vector<double> activations;
  std::vector<double> controls;
  std::vector<double> mocap_positions;
  std::vector<double> mocap_rotations;
};

/// What MuJoCo's models have beside the scene.
struct MujocoParts {
  std::vector<MujocoActuator> actuators;  ///< in the order of the stage, that of controls
  std::vector<MujocoKeyframe> keyframes;  ///< in the order of the stage
  /// When the stage comes to each body: positions of keyframes go down the tree in this order.
  std::vector<Index> body_ranks;  ///< (body_count)
};

}  // namespace tenon::scene
