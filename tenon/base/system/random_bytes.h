// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "tenon/base/result.h"

namespace tenon {

/// `count` random bytes (at most 256) from the operating system, as hexadecimal digits, two for
/// each: they cannot be guessed. ErrorCode::Io where the system gives none.
Result<std::string> random_hex(std::size_t count);

}  // namespace tenon
