// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/asset/authoring/add_edits.h"
#include "tenon/asset/edit_asset.h"
#include "tenon/base/result.h"

namespace tenon {

/// What a request takes away, as edits. A path alone, or with a kind that makes a prim, is the prim
/// with all that names it; joints of a body that goes go with it. A kind that is put on a prim
/// takes its schemas along in every file that applies them, and what these alone declare. Errors:
/// those of reading requests; NotFound (edit.no-prim, edit.has-none), Invalid (edit.wrong-type).
Result<std::vector<AssetEdit>> remove_edits(const Stages& stages, const AuthoringRequest& request,
                                            const std::string& engine);

}  // namespace tenon
