// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/missing_input.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace tenon::cli {

bool tells_of_missing_input(const Diagnostic& finding) {
  static constexpr std::array<std::string_view, 9> kRules = {
      "clips.layer",           "compose.index-capacity-exceeded",
      "compose.work-exceeded", "compose.invalid-asset-path",
      "package.missing",       "compose.invalid-sublayer-path",
      "stage.too-many-prims",  "convert.mesh-unreadable",
      "urdf.mesh-missing"};
  return std::find(kRules.begin(), kRules.end(), finding.rule) != kRules.end();
}

void add_missing_input(const std::string& asset, const OpenOptions& options, Report& report) {
  Diagnostics found;
  if (!open_stage(asset, options, found)) {
    return;  // the verb itself says why
  }
  for (const Diagnostic& finding : found) {
    if (tells_of_missing_input(finding)) {
      report.diagnostics.add(finding);
    }
  }
}

}  // namespace tenon::cli
