// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/check/finding.h"

namespace tenon {

/// A finding as a report shows it.
struct ReportedFinding {
  check::Finding finding;
  bool suppressed = false;  ///< known by the baseline
};

/// What stays the same while lines move: rule, file as seen from `folder`, prim and property.
std::string fingerprint_of(const check::Finding& finding, const std::string& folder);

}  // namespace tenon
