// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/report.h"

/// The answers of tenon/answers/explain.h for people.
namespace tenon::cli {

std::string explain_prim_text(const Json& answer);
std::string explain_property_text(const Json& answer);
std::string explain_pair_text(const Json& answer);
/// The part of `explain_prim_text` that is about a joint.
std::string joint_text(const Json& joint);

}  // namespace tenon::cli
