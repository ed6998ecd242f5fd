// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/convert/robot_layer.h"

/// Internal to this folder.
namespace tenon::convert {

/// Writes the world that a model brings along, or reports that it is skipped.
void write_scene(const Source& source, PhysicsScope& physics);

}  // namespace tenon::convert
