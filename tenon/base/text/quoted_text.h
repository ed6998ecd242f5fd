// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

/// Strings as text layers and expressions write them.
namespace tenon {

/// In quotes, escaped: single quotes when the text holds double ones only, three of them when it
/// has several lines. Ends at a NUL.
std::string quoted_text(std::string_view text);

/// What stands between the quotes, with its escapes resolved.
std::string unescaped(std::string_view raw);

}  // namespace tenon
