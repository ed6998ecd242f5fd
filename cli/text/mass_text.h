// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/report.h"

namespace tenon::cli {

/// The answer of `answers::mass_json` for people.
std::string mass_text(const Json& mass, const std::string& indent);
/// The table of `answers::mass_table_json` in columns: three lines for each body.
std::string mass_table_text(const Json& table);

}  // namespace tenon::cli
