// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tenon/math/transform.h"
#include "tenon/math/vector.h"
#include "tenon/robot/mujoco_parts.h"

namespace tenon::robot {

/// How MuJoCo moves a camera or a light beside the link that it is on. None: it does not.
struct MujocoTracking {
  std::string mode;                     ///< "track", "trackcom", "targetbody", "targetbodycom"
  std::optional<std::uint32_t> target;  ///< into RobotModel::links, of the last two
};

/// Looks along -z, with y upwards.
struct Camera {
  std::string name;
  Pose pose;  ///< in the link frame
  bool orthographic = false;
  /// Width and height of the film, `offset` from its middle to where it is hit at right angles, and
  /// its distance behind the lens, in one unit, as only their ratios count. A width of 0: unknown.
  /// Orthographic: width and height of the view [m].
  Vec2d aperture;
  Vec2d offset;
  double focal_length = 0;
  std::array<double, 2> clipping{};  ///< nearest and farthest that is seen [m]; zeros: not told
  MujocoTracking tracking;
  std::vector<MujocoSetting> settings;  ///< of MuJoCo that are not its defaults
};

enum class LightKind : std::uint8_t {
  Directional,  ///< from far away, in parallel
  Spot,         ///< from a place, in a cone
  Point,        ///< from a place, all around
};

/// Shines along -z.
struct Light {
  std::string name;
  Pose pose;  ///< in the link frame
  LightKind kind = LightKind::Directional;
  /// What a white surface shows that it meets at right angles, `reach` away; 1: white [linear].
  Vec3d color{{1, 1, 1}};
  double reach = 1;     ///< [m]
  double radius = 0;    ///< of the ball that shines [m]; 0: a point
  double cone = 90;     ///< of Spot: from the middle to the edge [degrees]
  double softness = 0;  ///< of the edge, a share of the cone, 0 to 1
  double focus = 0;     ///< of Spot: falls off from the middle as the cosine to this power
  bool shadows = true;  ///< others cast shadows in it
  bool is_on = true;
  MujocoTracking tracking;
  std::vector<MujocoSetting> settings;  ///< of MuJoCo that are not its defaults
};

}  // namespace tenon::robot
