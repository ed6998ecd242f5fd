// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/report.h"

namespace tenon::cli {

/// The answer of `answers::where_json` for people: a line per opinion, and how it is reached.
std::string where_text(const Json& answer);

}  // namespace tenon::cli
