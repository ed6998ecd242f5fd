// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "tenon/answers/json.h"
#include "tenon/asset/convert_file.h"

namespace tenon {

/// How much the description holds.
struct RobotCounts {
  std::size_t links = 0;
  std::size_t joints = 0;
  std::size_t meshes = 0;  ///< files that were found
};
RobotCounts counts_of(const ConvertedFile& converted);

/// {"output", "links", "joints", "meshes"}.
answers::Json converted_json(const RobotCounts& counts, const std::string& output);

}  // namespace tenon
