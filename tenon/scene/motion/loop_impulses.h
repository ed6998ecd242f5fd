// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tenon/scene/motion/tree_inertia.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::scene {

/// One direction in which a joint holds two bodies together: what a unit impulse along it is.
struct LoopRow {
  Index joint = 0;
  std::optional<std::size_t> member0;
  std::optional<std::size_t> member1;
  Screw impulse;    // on member1; the opposite on member0
  double size = 1;  // makes rows of any mass alike: 1 / root of the speed that it gives
};

/// A rigid mimic: the speed of one column follows another's.
struct SpeedRow {
  std::size_t follower = 0;
  std::size_t leader = 0;
  double ratio = 1;
  double size = 1;
};

/// What members of a tree must not do beside what its columns let them do.
struct LoopRows {
  std::vector<LoopRow> rows;
  std::vector<SpeedRow> speed_rows;
};

/// The speed along a row, in its own size.
double speed_along(const LoopRow& row, const std::vector<Screw>& motions);

/// Changes the speeds of the columns that are sought by the impulses that end all violations, or
/// leave the least, where rows contradict each other. `base` (member_count) is the motion that is
/// prescribed, `given_speeds` (column_count) are those of given columns.
void close_loops(const MotionTree& tree, const TreeInertia& inertia, const LoopRows& loops,
                 const std::vector<Screw>& base, const std::vector<double>& given_speeds,
                 std::vector<double>& speeds);

}  // namespace tenon::scene
