// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/asset/edit_asset.h"
#include "tenon/base/result.h"

namespace tenon {

/// A request to edit an asset, as people write it (`tenon set`).
struct EditRequest {
  std::vector<std::string> assignments;  ///< PATH.property=VALUE; of relationships += and -=, too
  std::vector<std::string> clear;        ///< PATH.property
  std::vector<std::string> apply;        ///< PRIM=SCHEMA
  std::vector<std::string> remove;       ///< PRIM=SCHEMA
  std::vector<std::string> mass;         ///< this and the next: see typed_edits.h
  std::vector<std::string> collider;
  std::vector<std::string> material;
  std::vector<std::string> drive;
  std::vector<std::string> mimic;
  std::vector<std::string> filter;
  std::vector<std::string> layer;  ///< NAME=VALUE: metadata of the stage
  bool filter_overlaps = false;    ///< every pair of bodies that overlap at the start
  bool all_engines = false;  ///< what one engine has a form of its own for is edited there, too
  std::string type;          ///< of attributes that assignments create
};

/// The edits in a fixed order: schemas are removed and applied first, so that the properties that
/// they declare are known, then typed edits, assignments, and last clearing. Errors: Invalid for
/// text that cannot be read, and for an empty request without an engine, whose file may have to be
/// made; those of opening the asset, which some typed edits look at.
Result<std::vector<AssetEdit>> read_edits(const std::string& asset, const EditRequest& request,
                                          const EditOptions& options);

}  // namespace tenon
