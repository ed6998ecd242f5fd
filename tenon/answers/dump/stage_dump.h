// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <ostream>

#include "tenon/stage/stage.h"

namespace tenon::answers {

struct DumpOptions {
  bool stacks = false;            ///< layers and paths of every opinion
  bool builtins = false;          ///< also properties that only schemas give
  bool xforms = false;            ///< world transforms at the default time
  bool no_payloads = false;       ///< for the caller that opens the stage
  std::size_t full_arrays = 256;  ///< longest array that is written out in full
};

/// Canonical JSON of a composed stage, byte for byte what the same dump made with OpenUSD prints
/// (format "tenon-stage-dump-1"): prototypes are named after the smallest path that uses them,
/// numbers are doubles, files are relative to the root layer's folder. Vendor schemas do not count.
void write_stage_dump(const stage::Stage& stage, const DumpOptions& options, std::ostream& out);

}  // namespace tenon::answers
