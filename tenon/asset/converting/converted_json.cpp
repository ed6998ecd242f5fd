// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/converting/converted_json.h"

namespace tenon {

RobotCounts counts_of(const ConvertedFile& converted) {
  return {converted.links, converted.joints, converted.meshes};
}

answers::Json converted_json(const RobotCounts& counts, const std::string& output) {
  return {{"output", output},
          {"links", counts.links},
          {"joints", counts.joints},
          {"meshes", counts.meshes}};
}

}  // namespace tenon
