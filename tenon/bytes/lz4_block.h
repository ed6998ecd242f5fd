// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "tenon/base/result.h"

namespace tenon::bytes {

/// LZ4 blocks as crate files frame them: one byte with the number of chunks, 0 for a single chunk
/// that fills the rest; else each chunk has its size in four bytes before it.

/// At most `max_size` bytes. No more is allocated than LZ4 can make of `compressed`.
Result<std::string> lz4_decompress(std::span<const std::byte> compressed, std::size_t max_size);

std::string lz4_compress(std::span<const std::byte> plain);

}  // namespace tenon::bytes
