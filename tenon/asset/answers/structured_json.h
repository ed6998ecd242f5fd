// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tenon/answers/json.h"
#include "tenon/structure/make/make_package.h"

namespace tenon {

/// One file of an asset in Asset Structure 3.0.
struct PackageFile {
  std::string name;
  std::string role;
  std::size_t bytes = 0;
};
std::vector<PackageFile> package_files(const structure::Package& package);

/// {"interface", "files": [{"file", "role", "bytes"}], "variants", "selection", "moved": [{"from",
/// "to"}]}.
answers::Json structured_json(const structure::StructuredAsset& asset);

}  // namespace tenon
