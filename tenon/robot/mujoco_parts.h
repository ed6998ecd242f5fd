// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// What MuJoCo's models have beside the tree, in MuJoCo's words and units (SI, radians).
namespace tenon::robot {

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

/// A fixed tendon: its length is a sum of joint coordinates.
struct MujocoTendon {
  std::string name;
  std::vector<std::uint32_t> joints;  ///< (term_count), into RobotModel::joints
  std::vector<double> coefficients;   ///< (term_count)
  double stiffness = 0;
  double damping = 0;
  double friction = 0;
  double armature = 0;
  std::array<double, 2> spring_length{-1, -1};  ///< rest; between the two no force
  std::optional<std::array<double, 2>> range;
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

struct MujocoParts {
  std::vector<MujocoActuator> actuators;
  std::vector<MujocoTendon> tendons;
  std::vector<MujocoKeyframe> keyframes;
};

}  // namespace tenon::robot
