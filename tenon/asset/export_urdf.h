// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/stage/stage.h"

namespace tenon {

struct ExportedUrdf {
  std::string text;
  std::map<std::string, std::string> meshes;  ///< name in the text -> OBJ [m]
  std::size_t links = 0;
  std::size_t joints = 0;
};

/// A stage's robot as URDF (describe/describe_robot.h tells how): meshes are OBJ files in `folder`,
/// a name relative to the description, each content once. What URDF does not support goes to
/// `diagnostics`.
Result<ExportedUrdf> export_urdf(const stage::Stage& stage, const std::string& folder,
                                 Diagnostics& diagnostics);

}  // namespace tenon
