// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/system/random_bytes.h"

#include <algorithm>
#include <array>

#include <sys/random.h>

namespace tenon {

Result<std::string> random_hex(std::size_t count) {
  std::array<unsigned char, 256> bytes{};
  count = std::min(count, bytes.size());
  // Up to 256 bytes come whole or not at all (getrandom(2)).
  if (getrandom(bytes.data(), count, 0) != static_cast<ssize_t>(count)) {
    return Error(ErrorCode::Io, "the system gives no random bytes")
        .with_rule("system.random")
        .with_fix("look whether this system allows getrandom()");
  }
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    text += kDigits[bytes[i] >> 4];
    text += kDigits[bytes[i] & 15];
  }
  return text;
}

}  // namespace tenon
