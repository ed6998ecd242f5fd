// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tenon/base/result.h"

namespace tenon::bytes {

/// Lists of integers as crate files pack them (Core Spec 1.0.1, section on the binary format):
/// differences to the one before; the commonest difference once; a two-bit code for each, four to
/// a byte from the low bits up: 0 the commonest, 1 to 3 a short, middle or full-width difference
/// that follows in the tail (1, 2, 4 bytes for 32-bit lists; 2, 4, 8 for 64-bit); then LZ4.
/// T is std::int32_t, std::uint32_t, std::int64_t or std::uint64_t.

/// `count` integers; an Error when `compressed` cannot hold as many.
template <class T>
Result<std::vector<T>> decode_integers(std::span<const std::byte> compressed, std::uint64_t count);

/// The most integers that so many compressed bytes can hold.
std::uint64_t max_integer_count(std::uint64_t compressed_size);

template <class T>
std::string encode_integers(std::span<const T> integers);

}  // namespace tenon::bytes
