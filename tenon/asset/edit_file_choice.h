// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tenon/asset/edit_asset.h"
#include "tenon/base/result.h"
#include "tenon/stage/sources/opinion_sources.h"
#include "tenon/stage/stage.h"
#include "tenon/structure/layout.h"

/// Which file an edit belongs to. Internal to the wiring.
namespace tenon {

struct FileChoice {
  std::string layer;  ///< identifier
  std::string why;
};

struct FileQuestion {
  const stage::Stage& stage;
  const stage::Prim& prim;
  const AssetEdit& edit;
  const structure::RolesOfFiles& roles;    ///< empty: the asset has not this structure
  const std::vector<std::string>& layers;  ///< all of the asset, of all variants
  const EditOptions& options;
};

/// The file that is named by the options, that owns the thing under the structure, or that has the
/// strongest opinion on it. Errors: ErrorCode::NotFound, Invalid, with what can be done.
Result<FileChoice> choose_file(const FileQuestion& question);

/// The prim that must exist for an edit: for a new prim its parent; an invalid one where it is
/// missing.
stage::Prim prim_for(const stage::Stage& stage, const AssetEdit& edit);

/// The strongest place where an opinion of `layer` would count for what `edit` is about.
std::optional<stage::LayerSite> site_for(const stage::Stage& stage, const AssetEdit& edit,
                                         const std::string& layer);

/// A layer has an opinion on what `edit` is about: the value, the targets, the list of API schemas.
bool speaks(const stage::OpinionSource& source, const AssetEdit& edit);

/// "physx.usda" of "/a/b/physx.usda".
std::string file_part(const std::string& path);

}  // namespace tenon
