// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/asset/authoring/add_edits.h"
#include "tenon/asset/edit_asset.h"
#include "tenon/base/result.h"

namespace tenon {

/// What a request removes, as edits. A path alone, or with a kind that makes a prim, is the prim
/// and all references to it; joints of a removed body go with it. A kind that is applied to a prim
/// removes its schemas in every file that applies them, and properties that only these declare.
/// Errors: those of reading requests; NotFound (edit.no-prim, edit.has-none), Invalid
/// (edit.wrong-type).
Result<std::vector<AssetEdit>> remove_edits(const Stages& stages, const AuthoringRequest& request,
                                            const std::string& engine);

}  // namespace tenon
