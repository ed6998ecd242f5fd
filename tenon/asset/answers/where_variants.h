// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "tenon/answers/json.h"
#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/open_stage.h"
#include "tenon/stage/stage.h"

namespace tenon {

/// A composed asset and how it was opened.
struct OpenedAsset {
  const stage::Stage& stage;
  std::string path;
  OpenOptions open;
};

/// What `where` asks about.
struct WhereQuestion {
  Path prim;
  Token property;  ///< empty: the prim itself
  std::optional<double> time;
};

/// Adds to `answer` of answers::where_json the opinions under the variants of the default prim's
/// set "Physics" that are not selected. Errors: those of opening the asset under them.
Result<void> add_other_variants(const OpenedAsset& asset, const WhereQuestion& question,
                                answers::Json& answer);

}  // namespace tenon
