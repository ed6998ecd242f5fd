// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tenon/asset/edit_asset.h"
#include "tenon/base/result.h"
#include "tenon/stage/stage.h"

namespace tenon {

/// A prim to add or remove, as people write it.
struct AuthoringRequest {
  std::vector<std::string> what;               ///< PATH=KIND or PATH=KIND,KIND,...
  std::map<std::string, std::string> options;  ///< of authoring_options(), without dashes
  std::vector<std::string> properties;         ///< NAME=VALUE, of all that is added
  bool match = false;  ///< PATH of what is added is a pattern (matched_prims.h)
};

using Stages = std::vector<std::shared_ptr<const stage::Stage>>;

/// What a request adds, as edits in the order in which they can be made; the properties of a prim
/// that is made are one wish, and so are those of each kind that is put on one. `stages` are the
/// asset under all its selections of "Physics". Errors: Invalid (edit.bad-argument,
/// edit.unknown-kind, edit.has-it-already, edit.wrong-type, edit.no-body), NotFound (edit.no-prim).
/// Files that references and meshes name are read: errors are those of reading them, too, and what
/// is skipped of them goes to `diagnostics`.
Result<std::vector<AssetEdit>> add_edits(const Stages& stages, const AuthoringRequest& request,
                                         const EditOptions& options, Diagnostics& diagnostics);

}  // namespace tenon
