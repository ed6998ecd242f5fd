// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/report.h"

namespace tenon::cli {

/// The rows of `answers::opinions_json` for people, a line each.
std::string opinions_text(const Json& opinions, const std::string& indent);

}  // namespace tenon::cli
