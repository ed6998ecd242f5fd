// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "tenon/scene/motion/joint_tree.h"

namespace tenon::dynamics {

/// What loops and mimics hold, by the columns of the tree: first the loop rows, along unit axes
/// [m/s, rad/s], then a row for each mimic, follower minus slope times leader (row_count x
/// column_count).
Eigen::MatrixXd constraint_matrix(const scene::JointTree& tree);

}  // namespace tenon::dynamics
