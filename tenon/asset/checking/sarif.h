// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/answers/json.h"
#include "tenon/asset/checking/reported_finding.h"
#include "tenon/bytes/files.h"

namespace tenon {

/// SARIF 2.1.0 (OASIS, 27 March 2020): one run with the rules that were broken and a result for
/// each finding; files relative to the working folder. `version` is the program's; columns
/// are told from the text in `files`.
answers::Json sarif_log(const std::vector<ReportedFinding>& findings, const std::string& version,
                        const bytes::Files& files);

}  // namespace tenon
