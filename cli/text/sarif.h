// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cli/report.h"
#include "tenon/check/finding.h"

namespace tenon::cli {

/// A finding as a report shows it.
struct ReportedFinding {
  check::Finding finding;
  bool suppressed = false;  ///< known by the baseline
};

/// SARIF 2.1.0 (OASIS, 27 March 2020): one run with the rules that were broken and a result for
/// each finding; files relative to the working folder. Columns are told from the text in `files`.
Json sarif_log(const std::vector<ReportedFinding>& findings, const bytes::Files& files);

/// What stays the same while lines move: rule, file, prim and property.
std::string fingerprint_of(const check::Finding& finding, const std::string& folder);

}  // namespace tenon::cli
