// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "tenon/answers/dump/json_writer.h"
#include "tenon/layer/field_values.h"

namespace tenon::answers {

/// How values become JSON in a stage dump.
struct ValueStyle {
  std::size_t full_arrays = 256;
  /// A path in the stage as text; prototypes by the name of their first user.
  std::function<std::string(Path)> path_text;
  /// A path expression likewise.
  std::function<std::string(const std::string&)> expression_text;
  /// A resolved file relative to the root layer's folder.
  std::function<std::string(const std::string&)> file_text;
};

/// Vectors and matrices as lists, quaternions real part first, assets as
/// {"$asset", "resolved"}, arrays longer than `full_arrays` by size, hash, head and tail.
void write_value(JsonWriter& json, const layer::Value& value, const ValueStyle& style);

}  // namespace tenon::answers
