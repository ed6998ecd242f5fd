// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/bytes/read_policy.h"
#include "tenon/open_stage.h"
#include "tenon/structure/make/make_package.h"

namespace tenon {

/// A layer that is in no file and stands alone as the source of a structured asset; its asset paths
/// are absolute. Files are collected under `policy`.
structure::AssetSource asset_source(layer::Layer layer, const bytes::ReadPolicy& policy);

/// The asset in Asset Structure 3.0, in no folder yet (structure/make/make_package.h tells what is
/// done; engines' layers beside physics.usda that no variant loads are taken along as variants;
/// structure::write_package puts it into a folder). Of the options files, sandbox, search paths and
/// what may be read count; writing is to the disk; layers from elsewhere are named in
/// `diagnostics`.
Result<structure::StructuredAsset> structure_asset(const std::string& path, const OpenOptions& open,
                                                   const structure::StructureOptions& options,
                                                   Diagnostics& diagnostics);

}  // namespace tenon
