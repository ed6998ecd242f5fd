// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/answers/json.h"
#include "tenon/asset/viewing/record_asset.h"
#include "tenon/asset/viewing/report_asset.h"

namespace tenon {

/// {"output", "size" [bytes], "triangles", "frames", "findings"}: what a report holds.
answers::Json report_json(const AssetReport& report, const std::string& output);

/// {"output", "size" [bytes], "width", "height" [pixels], "frames", "duration" [s], "codec" (null:
/// a picture), "triangles", "browser"}: what a recording is.
answers::Json record_json(const RecordedAsset& recorded, const RecordOptions& options,
                          const std::string& output);

}  // namespace tenon
