// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/convert/convert_robot.h"
#include "tenon/robot/robot_model.h"

namespace tenon::convert {

/// Where the robot's prim keeps the source: its text, its seal, parts of that, and behind a number
/// its files.
inline constexpr const char* kSourceText = "tenon:mjcf:model";
inline constexpr const char* kSourceSeal = "tenon:mjcf:seal";
inline constexpr const char* kSourceParts = "tenon:mjcf:parts";
inline constexpr const char* kSourceFile = "tenon:mjcf:file";

/// Writes what `model` keeps of its source to the robot's prim of a finished layer; nothing where
/// the options ask for another robot than the source's. Files that may not be read, and what is
/// neither a shape nor an image, leave all of it out, which is said.
void write_source(const robot::RobotModel& model, const ConvertOptions& options,
                  layer::Layer& layer, Diagnostics& diagnostics);

}  // namespace tenon::convert
