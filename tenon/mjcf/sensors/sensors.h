// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/mjcf/bodies.h"
#include "tenon/mjcf/mjcf_source.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// Gives sites and joints the sensors that measure them, after joints have their drives. Other
/// sensors are listed as left out, and so are cutoffs, noise, delays and intervals.
void read_sensors(MjcfSource& source, BodyTree& tree);

}  // namespace tenon::mjcf
