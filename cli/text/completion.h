// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "cli/command_table.h"

namespace tenon::cli {

/// What makes the shell complete verbs, options and closed choices of `program`, files elsewhere.
/// Shells: bash, zsh, fish; nothing for others.
std::optional<std::string> completion_script(const CommandInfo& program, std::string_view shell);

}  // namespace tenon::cli
