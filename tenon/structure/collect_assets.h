// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/diagnostics.h"
#include "tenon/structure/make_package.h"

namespace tenon::structure {

/// Puts the files that attributes of the package's layers name into its folder "Textures" (modules
/// of materials into "Materials" with Names::Tutorial), each content once, and makes the paths to
/// them relative. `<UDIM>` patterns bring all their tiles. What cannot be read stays as it is
/// named, with the diagnostic "structure.asset-missing".
void collect_assets(const AssetSource& source, Names names, Package& package,
                    Diagnostics& diagnostics);

}  // namespace tenon::structure
