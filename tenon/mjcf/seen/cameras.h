// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/mjcf/bodies.h"
#include "tenon/mjcf/mjcf_source.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// Gives the links of `tree` their cameras and lights. Lights that are images are skipped.
void read_cameras_and_lights(MjcfSource& source, BodyTree& tree);

}  // namespace tenon::mjcf
