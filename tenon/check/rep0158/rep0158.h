// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/check/simready/requirement.h"

/// The requirements of ROS's REP-0158, by the codes of its checker: one table, requirements.def.
/// They are judged by the means of tenon/check/simready.
namespace tenon::check::rep0158 {

/// Those of a robot, in the order of their sections; of family "rep-0158".
const std::vector<simready::Requirement>& requirements();

}  // namespace tenon::check::rep0158
