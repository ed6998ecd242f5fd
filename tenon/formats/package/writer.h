// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/layer/layer.h"

namespace tenon::formats {

/// A file of a package beside its root layer: the name that the layers use for it, and its bytes.
struct PackageFile {
  std::string name;
  std::shared_ptr<const bytes::FileBytes> contents;
};

/// A package (.usdz) with the layer, as a binary file named `root_name`, in front of the other
/// files: Core Spec 1.0.1, section on packages. Asset paths in the layer are left as they are.
/// Errors: those of write_crate and bytes::write_zip.
Result<std::string> write_package(const layer::Layer& root, const std::vector<PackageFile>& files,
                                  const std::string& root_name = "root.usdc");

}  // namespace tenon::formats
