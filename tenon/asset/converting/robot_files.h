// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/asset/convert_file.h"
#include "tenon/asset/made_file.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/structure/make/make_package.h"
#include "tenon/structure/written_note.h"

/// A converted robot as the files of an asset.
namespace tenon {

/// Files that record what was written, for the next run (structure/written_note.h).
struct NotedFiles {
  MadeFiles files;                  ///< the asset or description last
  structure::Digests beside;        ///< of the others, by their names from there
  layer::LayerPtr layer = nullptr;  ///< what the asset says; null for descriptions and packages
};
/// The same as files of the folder of `output`, for assets that are no packages.
Result<structure::Package> package_of(const NotedFiles& made, const std::string& output);

/// One layer or package for a file at `output`, and images beside it: those that are in no file of
/// their own, and those outside of the folders of the output; beside a layer also a copy of the
/// output (updating/base_copy.h). No file is touched. Errors: those of encoding; Invalid for the
/// name.
Result<NotedFiles> robot_files(ConvertedFile converted, const std::string& output,
                               Diagnostics& diagnostics);

/// As `tenon structure` would make it of the same asset in a file, verified in the same way.
Result<structure::StructuredAsset> structured_robot(
    const ConvertedFile& converted, Diagnostics& diagnostics,
    const structure::StructureOptions& options = {});

}  // namespace tenon
