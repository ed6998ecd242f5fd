// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/report.h"
#include "tenon/diff/layer_difference.h"
#include "tenon/diff/physics_difference.h"

namespace tenon::cli {

/// {"change", "path", "kind", "field", "key", "before", "after", "beforeLine", "afterLine",
/// "specs", "elements", "differentElements", "largest"}; values as text layers print them.
Json difference_json(const diff::Difference& difference);
/// One line, "~ /A.size  default 1 -> 2", without a line feed.
std::string difference_text(const diff::Difference& difference);

/// {"change", "object", "path", "what", "unit", "before", "after", "largest"}; SI and radians.
Json difference_json(const diff::PhysicsDifference& difference);
/// One line, "~ joint /j  upper limit 75 deg -> 60 deg"; angles in degrees.
std::string difference_text(const diff::PhysicsDifference& difference);

}  // namespace tenon::cli
