// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/mjcf/bodies.h"
#include "tenon/mjcf/mjcf_source.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// Gives sites and joints the sensors that measure them, after joints have their drives; -> all
/// sensors as they are written, for models made of the asset. Those that runs do not measure, or
/// measure without their cutoff, noise, delay or interval, are listed.
std::vector<robot::MujocoSensor> read_sensors(MjcfSource& source, BodyTree& tree);

}  // namespace tenon::mjcf
