// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/answers/json.h"
#include "tenon/asset/updating/update_asset.h"

namespace tenon {

/// {"files": [{"file", "removed"}], "edits", "changes", "moved": [{"from", "to"}], "conflicts":
/// [{"file", "kind", "prim", "property", "field", "key", "base", "edit", "source", "kept"}]};
/// "kind" is "values", "removedBySource" or "removedByEdit", "kept" is "edit" or "source"; values
/// are text.
answers::Json updated_json(const UpdatedAsset& asset, diff::Side keep);
/// The answer of a verb with this as "updated".
answers::Json with_updated(answers::Json answer, const UpdatedAsset& asset, diff::Side keep);

}  // namespace tenon
