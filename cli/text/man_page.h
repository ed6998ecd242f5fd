// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/command_table.h"

namespace tenon::cli {

/// The manual page tenon(1) in roff: all verbs with their options and examples.
std::string man_page(const CommandInfo& program, const std::string& version);

}  // namespace tenon::cli
