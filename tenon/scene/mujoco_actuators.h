// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/scene/mujoco_parts.h"
#include "tenon/scene/physics_scene.h"

/// MuJoCo's actuators, keyframes and sensors as assets have them: for those who write models.
namespace tenon::scene {

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

/// A TenonMujocoSensor: one of MuJoCo's sensors, in MuJoCo's words.
struct MujocoSensor {
  /// A prim, and MuJoCo's word for what it is of it ("xbody", "site"). Empty: nothing.
  struct Thing {
    std::string kind;
    Path prim;
  };

  Path path;
  std::string kind;  ///< "framepos"
  Thing object;
  Thing reference;
  /// The sensor of the scene that measures it in runs: with a body, or a joint. None: nothing does.
  std::optional<Path> instrument;
  std::vector<VendorSetting> settings;  ///< numbers, by mjsSensor's names
};

/// What MuJoCo's models have beside the scene.
struct MujocoParts {
  std::vector<MujocoActuator> actuators;  ///< in the order of the stage, that of controls
  std::vector<MujocoKeyframe> keyframes;  ///< in the order of the stage
  std::vector<MujocoSensor> sensors;      ///< in the order of the stage
  /// When the stage comes to each body: positions of keyframes go down the tree in this order.
  std::vector<Index> body_ranks;  ///< (body_count)
};

}  // namespace tenon::scene
