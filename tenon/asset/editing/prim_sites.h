// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/stage/stage.h"
#include "tenon/structure/layout.h"

/// Internal to the wiring.
namespace tenon {

/// Where the files of an asset may say something about a prim: path of its specs, without variant
/// selections, by layer identifier. Layers that arcs of the prim itself bring in are not among
/// them.
using PrimSites = std::map<std::string, Path>;

/// The sites of a prim that can be removed or renamed: files of the asset's own alone name it. Own
/// are the layers of the root layer stack, and in an asset of the structure 3.0 all files of it.
/// `stages` are the asset under all its selections. Errors: NotFound (edit.no-prim); Invalid
/// (edit.instance-proxy, edit.over-arc).
Result<PrimSites> own_sites(const std::vector<std::shared_ptr<const stage::Stage>>& stages,
                            const structure::RolesOfFiles& roles, Path prim);

}  // namespace tenon
