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

}  // namespace tenon
