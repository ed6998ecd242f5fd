// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/mjcf/bodies.h"
#include "tenon/mjcf/mjcf_source.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::mjcf {

struct Equalities {
  std::vector<robot::LoopJoint> loops;
  std::vector<std::optional<robot::Mimic>> mimics;  ///< (joint_count), by BodyTree::joints
};

/// Equalities of other kinds, and those that are off, are listed as skipped.
Equalities read_equalities(MjcfSource& source, const BodyTree& tree);

/// Lets joints follow others.
void attach_mimics(const Equalities& equalities, std::vector<robot::Joint>& joints);

}  // namespace tenon::mjcf
