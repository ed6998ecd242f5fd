// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/bytes/read_policy.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"

namespace tenon {

struct ExportedMjcf {
  std::string text;
  std::map<std::string, std::string> images;  ///< name in the text -> bytes
};

/// A physics scene, read from `stage`, in MuJoCo's own format, with its visuals
/// (mjcf/write_model.h): images are copied into `folder`, a name relative to the text, as far as
/// `policy` allows. What MJCF does not support goes to `diagnostics`. ErrorCode::Missing in a build
/// without MuJoCo.
Result<ExportedMjcf> export_mjcf(const stage::Stage& stage, const scene::PhysicsScene& scene,
                                 const std::string& folder, const bytes::ReadPolicy& policy,
                                 Diagnostics& diagnostics);

}  // namespace tenon
