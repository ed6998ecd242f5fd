// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/check/finding.h"
#include "tenon/layer/layer.h"

namespace tenon::check {

/// The edits of all fixes, by the identifier of their layer. Of several that change one field of
/// one spec the first counts, so that what several findings ask for is done once.
std::map<std::string, std::vector<SpecEdit>> edits_by_layer(const std::vector<Finding>& findings);

/// Carries them out. ErrorCode::NotFound when a spec is gone.
Result<void> apply_edits(const std::vector<SpecEdit>& edits, layer::Layer& layer);

}  // namespace tenon::check
