// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/robot/robot_model.h"

namespace tenon::sdf {

/// Puts what SDFormat has in the place of what it lacks, and says so ("sdf.replaced"): names that
/// are reserved or given to two parts of a model get others, a planar joint becomes two slides and
/// a hinge on links of almost no mass, a mass or a moment of 0 becomes one that readers take.
/// Shapes of links without inertia go to the link that holds these. Parts that are new come after
/// those that are there.
void make_plain(robot::RobotModel& model, Diagnostics& diagnostics);

/// How links without inertia hang on others: a link on a fixed joint that weighs nothing is a frame
/// of the link that carries it.
struct Carriers {
  std::vector<robot::Index> link;  ///< (link_count) itself, or the link whose frame it is
  std::vector<Pose> pose;          ///< (link_count) of the link in that one
  std::vector<char> is_frame;      ///< (link_count)
  robot::Index root = 0;
  bool root_is_world = false;  ///< it has no inertia
};
Carriers carriers_of(const robot::RobotModel& model);

}  // namespace tenon::sdf
