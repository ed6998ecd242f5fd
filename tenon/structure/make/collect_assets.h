// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/structure/make/make_package.h"

namespace tenon::structure {

/// Where files went: asset path, absolute except for search paths -> name in the package.
using CollectedAssets = std::map<std::string, std::string>;

/// Puts the files that attributes of the package's layers name into its folder "Textures" (modules
/// of materials into "Materials" with Names::Tutorial), files of one name and content once, and
/// makes the paths to them relative. `<UDIM>` patterns bring all their tiles. What cannot be read
/// is named where it would be, with the diagnostic "structure.asset-missing": the asset can be
/// moved all the same. Files found by a search path are collected as well; a name that leads
/// nowhere stays, with the same diagnostic except for modules of renderers. So does a file outside
/// of the asset's folders, or one of a kind that no scene shows or plays, with an error:
/// "read.outside", "read.wrong-kind" (docs/reading.md).
CollectedAssets collect_assets(const AssetSource& source, Names names, Package& package,
                               Diagnostics& diagnostics);

/// The content with asset paths as a stage of the package has them (identifier_in_package).
layer::Layer with_collected_assets(const layer::Layer& content, const CollectedAssets& assets);

}  // namespace tenon::structure
