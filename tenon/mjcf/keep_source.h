// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/mjcf/mjcf_source.h"
#include "tenon/robot/mujoco_parts.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// A model's options of MuJoCo's compiler on unneeded bodies and visuals.
struct Simplified {
  bool fuses_static = false;
  bool drops_visuals = false;
};

/// A compiled model as MuJoCo writes it, with every bit of its numbers and with its files. Nothing,
/// and a finding, where a file is not found.
robot::MujocoSource keep_source(MjcfSource& source, mjSpec& spec, const Simplified& simplified);

}  // namespace tenon::mjcf
