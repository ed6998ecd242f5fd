// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/stage/stage.h"

namespace tenon {

struct ExportedSrdf {
  std::string text;
  std::size_t links = 0;
  std::size_t joints = 0;
};

/// What MoveIt needs beside the URDF that export_urdf writes: a group "all" of the joints with one
/// axis, the start and the named poses of the asset as its states, passive joints, how the root
/// is held in the world, and pairs of links that joints or filters keep apart. Pairs that never
/// touch are found by `pairs`. What it cannot name goes to `diagnostics` as "srdf.left-out".
/// Errors: those of describe_robot.
Result<ExportedSrdf> export_srdf(const stage::Stage& stage, Diagnostics& diagnostics);

}  // namespace tenon
