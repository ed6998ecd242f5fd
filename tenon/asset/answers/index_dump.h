// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/open_stage.h"

namespace tenon {

/// Where findings of a dump go.
struct IndexFindings {
  Diagnostics& opening;
  Diagnostics& missing;  ///< arcs whose layer cannot be opened, which the text names as well
};

/// How prims of the asset at `path` are composed, as compose::dump_indices writes it, layers named
/// from the folder of the root layer; without prims, of all. Errors: those of open_indices; Invalid
/// for an invalid path.
Result<std::string> dump_index(const std::string& path, const OpenOptions& options,
                               const std::vector<std::string>& prims, IndexFindings findings);

}  // namespace tenon
