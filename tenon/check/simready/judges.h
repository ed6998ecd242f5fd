// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/check/simready/requirement.h"

/// The functions of requirements.def, one for each requirement that a file shows.
namespace tenon::check::simready {

#define TENON_REQUIREMENT(family, code, robot, prop, runtime, judge, asks) Judge judge;
#define TENON_OPEN(family, code, robot, prop, runtime, asks, reason)
#include "tenon/check/simready/requirements.def"

}  // namespace tenon::check::simready
