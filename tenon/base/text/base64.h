// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tenon {

/// Bytes as text of RFC 4648, section 4, padded.
std::string base64_text(std::string_view bytes);

/// The same back; nothing for what base64_text() does not write.
std::optional<std::string> bytes_of_base64(std::string_view text);

}  // namespace tenon
