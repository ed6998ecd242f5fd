// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/command_line.h"
#include "tenon/answers/json.h"

namespace tenon::cli {

/// The table of options of the program and of all verbs: what the command says of itself.
/// {"options", "verbs": [{"name", "about", "options", "verbs"}]}.
answers::Json command_json(const CommandInfo& program);

}  // namespace tenon::cli
