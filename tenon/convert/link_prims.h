// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/convert/robot_layer.h"

/// Internal to this folder.
namespace tenon::convert {

inline bool has_mass(const robot::Link& link) { return link.inertial && link.inertial->mass > 0; }

/// What a link is as a prim.
enum class LinkRole : unsigned char {
  Body,
  Static,  ///< stands still with the robot
  Frame,   ///< a part of the link that holds it
};

struct LinkPrim {
  Path path;
  LinkRole role = LinkRole::Body;
  robot::Index host = 0;  ///< the link itself, or the one that a frame is a part of
  Pose in_host;           ///< of the link
  Pose in_robot;
  /// Of a link without mass and colliders: whose mass it gets a share of, the first that it carries
  /// or else the one that carries it.
  std::optional<robot::Index> mass_of{};
  bool carries_mass = true;  ///< it, or something that hangs on it
};

/// Where the links of a robot are on the stage.
struct LinkPrims {
  std::vector<LinkPrim> prims;          ///< (link_count)
  std::optional<robot::Index> carried;  ///< of a root that moves without a mass: whose it shares

  const LinkPrim& operator[](robot::Index link) const { return prims[link]; }
  const LinkPrim& host(robot::Index link) const { return prims[prims[link].host]; }
};

/// Roles, paths below `robot` and poses of all links, with names of their own in the whole robot.
/// Errors: Limit "convert.too-deep" for a chain that cannot be nested.
Result<LinkPrims> place_links(const Source& source, Path robot);

/// Makes the prims, each after its parent.
void define_links(const Source& source, const LinkPrims& links, RobotLayer& layer);

}  // namespace tenon::convert
