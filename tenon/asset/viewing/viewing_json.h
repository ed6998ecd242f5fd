// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/answers/json.h"
#include "tenon/asset/viewing/report_asset.h"

namespace tenon {

/// {"output", "size" [bytes], "triangles", "frames", "findings"}: what a report holds.
answers::Json report_json(const AssetReport& report, const std::string& output);

}  // namespace tenon
