// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/compose/cache/index_cache.h"
#include "tenon/open_stage.h"

namespace tenon {

/// The composition of a file before it is populated, for users of its indices.
Result<std::unique_ptr<compose::IndexCache>> open_indices(const std::string& path,
                                                          const OpenOptions& options,
                                                          Diagnostics& diagnostics);

}  // namespace tenon
