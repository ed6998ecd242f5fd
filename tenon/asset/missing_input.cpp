// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/missing_input.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace tenon {

bool tells_of_missing_input(const Diagnostic& finding) {
  static constexpr std::string_view kRules[] = {
      "clips.layer",
      "compose.index-capacity-exceeded",
      "compose.invalid-asset-path",
      "compose.invalid-sublayer-path",
      "compose.variable-expression-error",
      "compose.work-exceeded",
      "convert.mesh-unreadable",
      "package.expression",
      "package.missing",
      "sdf.include-missing",
      "sdf.mesh-missing",
      "stage.too-many-prims",
      "urdf.mesh-missing",
  };
  return std::find(std::begin(kRules), std::end(kRules), finding.rule) != std::end(kRules);
}

void add_missing_input(const std::string& asset, const OpenOptions& options,
                       Diagnostics& diagnostics) {
  Diagnostics found;
  if (!tenon::open(asset, options, found)) {
    return;  // the verb itself says why
  }
  for (const Diagnostic& finding : found) {
    if (tells_of_missing_input(finding)) {
      diagnostics.add(finding);
    }
  }
}

}  // namespace tenon
