// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/bytes/read_policy.h"

namespace tenon::mesh {

/// What the members "uri" of a glTF file, JSON or GLB, name: without data URIs and images, which
/// are judged where they are used.
std::vector<std::string> gltf_uris(std::string_view bytes);

/// Numbers of a glTF file may be in other files. Error under bytes::kOutsideRule, with the file,
/// for one that exists outside the folders that may be read.
Result<void> check_gltf_files(std::string_view bytes, const std::string& path,
                              const bytes::ReadPolicy& policy);

}  // namespace tenon::mesh
