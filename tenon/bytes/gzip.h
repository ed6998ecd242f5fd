// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tenon::bytes {

/// The bytes as a gzip file (RFC 1952), as small as zlib makes it, with no name or time in it.
/// Nothing where zlib is not there, which is opened when it is first needed.
std::optional<std::string> gzipped(std::string_view bytes);

/// Bytes as UTF-8 text that a data block of HTML can hold, a sixth longer than they are: seven
/// bits, the highest first, are one character; those that HTML changes or reads (0, 13 and 60, `<`)
/// are 256 higher. The last one is filled up with zeros.
std::string seven_bit_text(std::string_view bytes);

}  // namespace tenon::bytes
