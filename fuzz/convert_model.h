// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdlib>
#include <utility>

#include "tenon/convert/convert_robot.h"
#include "tenon/formats/save_layer.h"
#include "tenon/robot/robot_model.h"

namespace tenon::fuzz {

/// Converts a robot, with options that follow from the size of the input. The resulting layer
/// must be writable as text.
inline void convert_model(robot::RobotModel model, std::size_t size, Diagnostics& diagnostics) {
  convert::ConvertOptions options;
  options.flat = size % 2 == 0;
  options.merge_fixed = size % 3 == 0;
  options.schema = convert::SchemaGeneration::Both;
  const auto layer = convert::convert_robot(std::move(model), options, diagnostics);
  if (layer && !formats::encode_layer(*layer, formats::LayerFormat::Text)) {
    std::abort();
  }
}

}  // namespace tenon::fuzz
