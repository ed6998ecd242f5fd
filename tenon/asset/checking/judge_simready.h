// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/result.h"
#include "tenon/check/simready/requirement.h"
#include "tenon/open_stage.h"

namespace tenon {

/// "simready", "simready-robot", "simready-prop", each alone or with the release: "@2026.8"; and
/// "rep-0158".
bool has_codes(const std::string& profile);

/// The asset judged by the requirements of such a profile; for "simready" as a robot where it has
/// joints, else as a prop. Fails as tenon::open does.
Result<check::simready::Judgement> judge_by_codes(const std::string& path,
                                                  const OpenOptions& options,
                                                  const std::string& profile);

}  // namespace tenon
