// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cli/report.h"
#include "tenon/asset/edit_asset.h"

namespace tenon::cli {

/// One line for each edit, or for each prim in each file unless everything is asked for.
enum class EditLines : unsigned char { OfEdits, OfPrims };

/// Says where each edit went, what engines receive otherwise and which files changed, as text or
/// JSON; in a dry run standard output is the difference alone. Returns the exit code: kNo where an
/// edit has no effect, so that nothing is to be written.
int finish_edits(Report& report, const std::vector<AssetEdit>& edits, const EditedAsset& asset,
                 bool dry_run, EditLines lines = EditLines::OfEdits);

}  // namespace tenon::cli
