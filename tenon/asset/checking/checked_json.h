// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "tenon/answers/json.h"
#include "tenon/asset/checking/check_assets.h"

namespace tenon {

/// {"diagnostics": rows of diagnostic_json and "variants", "numbers", "autofix", "suggestedFix",
/// "suppressed", "code";
/// "summary": {"errors", "warnings", "infos", "fixable", "suggested", "suppressed"}, "assets":
/// [{"asset", "opened", "variants", "settings", "codes"}], "skipped": [{"rule", "reason", "count",
/// "settings"}]}, and what was corrected: [{"file", "diff"}], under the key `corrected_key`, unless
/// that is empty.
answers::Json checked_json(const CheckedAssets& checked, std::string_view corrected_key);

/// {"rules": [{"rule", "severity", "numbers", "autofix", "suggestedFix", "title"}]}: all that there
/// are.
answers::Json rules_json();

}  // namespace tenon
