// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/command_table.h"

namespace tenon::cli {

constexpr std::size_t kHelpWidth = 80;  ///< where nothing says how wide the terminal is

/// Help of `command`, which is called as `name` ("tenon check"), in lines of at most `width`
/// columns as far as single words allow. `shared` are the options that every verb takes.
std::string help_text(const CommandInfo& command, const std::string& name,
                      const std::vector<OptionInfo>& shared, std::size_t width);

/// `text` in lines of at most `width` columns; each but the first begins with `indent` blanks.
std::string wrapped(std::string_view text, std::size_t width, std::size_t indent = 0);

/// The help of an option with what its values are: choices, range.
std::string option_help(const OptionInfo& option);

/// "tenon check [OPTIONS] asset...".
std::string usage_line(const CommandInfo& command, const std::string& name);

}  // namespace tenon::cli
