// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tenon::cli {

/// `text` with everything escaped that would act on a terminal or reorder its text: control
/// characters (as "\x1b"), bidirectional overrides and marks, line and paragraph separators, the
/// byte order mark (as "\u202e"), and bytes that are no UTF-8. Line feeds and tabs stay when
/// `keep_layout`.
std::string terminal_text(std::string_view text, bool keep_layout);

}  // namespace tenon::cli
