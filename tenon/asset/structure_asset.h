// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/structure/make_package.h"
#include "tenon/tenon.h"

namespace tenon {

/// A file of any kind as the source of a structured asset; keeps what it opens.
Result<structure::AssetSource> asset_source(const std::string& path, const OpenOptions& options);

/// The same of a layer that is in no file and stands alone; its asset paths are absolute.
structure::AssetSource asset_source(layer::Layer layer);

/// The asset in Asset Structure 3.0, in no folder yet (structure/make_package.h tells what is done;
/// structure::write_package puts it into a folder). Of the options sandbox and search paths count.
Result<structure::StructuredAsset> structure_asset(const std::string& path, const OpenOptions& open,
                                                   const structure::StructureOptions& options,
                                                   Diagnostics& diagnostics);

}  // namespace tenon
