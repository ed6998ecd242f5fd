// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/result.h"
#include "tenon/bytes/read_policy.h"

namespace tenon {

/// Looks at the files that a model in MuJoCo's format names, includes and what those name among
/// them, before MuJoCo opens them. Folders that hold parts of robots by convention
/// (bytes/asset_roots.h) join `policy`. Error under bytes::kOutsideRule, with file and line, for
/// a file that is elsewhere; Limit for kNamedFiles and kReplicatedElements. Does not report models
/// that are not XML, or missing files: MuJoCo does.
Result<void> admit_mjcf_files(const std::string& path, bytes::ReadPolicy& policy);

}  // namespace tenon
