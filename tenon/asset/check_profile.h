// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/result.h"
#include "tenon/open_stage.h"
#include "tenon/structure/check_structure.h"

namespace tenon {

/// The files of the asset that `path` opens: itself and all layers in the folder "payloads" beside
/// it. Layers there that cannot be opened are skipped; opening the asset reports them.
Result<structure::AssetFiles> asset_files(const std::string& path, const OpenOptions& options);

}  // namespace tenon
