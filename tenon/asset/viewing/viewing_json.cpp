// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/viewing/viewing_json.h"

namespace tenon {

answers::Json report_json(const AssetReport& report, const std::string& output) {
  return {{"output", output},
          {"size", report.html.size()},
          {"triangles", report.triangles},
          {"frames", report.frames},
          {"findings", report.findings}};
}

answers::Json record_json(const RecordedAsset& recorded, const RecordOptions& options,
                          const std::string& output) {
  return {
      {"output", output},
      {"size", recorded.contents.size()},
      {"width", options.width},
      {"height", options.height},
      {"frames", recorded.frames},
      {"duration", recorded.duration},
      {"codec", recorded.codec.empty() ? answers::Json(nullptr) : answers::Json(recorded.codec)},
      {"triangles", recorded.triangles},
      {"browser", recorded.browser}};
}

}  // namespace tenon
