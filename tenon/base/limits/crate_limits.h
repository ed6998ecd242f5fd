// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

/// Binary layers: what a file may ask for. The packed tables of regular scenes shrink without a
/// bound that follows from the size of the file (a million prims in 12 kB), so each table has a
/// base that every file may fill, and more in proportion to its size. Rows cost memory only once
/// they have been checked.
namespace tenon::limits {

inline constexpr std::uint64_t kCrateRows = 1u << 24;          ///< paths, specs of any file
inline constexpr std::uint64_t kCrateFieldSetRows = 1u << 23;  ///< rows of sets of fields
inline constexpr std::uint64_t kCrateFields = 1u << 20;        ///< different fields, sets of them
inline constexpr std::uint64_t kCrateTokens = 1u << 17;        ///< tokens of any file
inline constexpr std::uint64_t kCrateTokensPerByte = 2;        ///< more per byte of their table
inline constexpr std::uint64_t kCrateArrays = 1u << 28;        ///< bytes of unpacked arrays
inline constexpr std::uint64_t kCrateArraysPerByte = 64;       ///< the same, more per byte
inline constexpr std::uint64_t kRepeatedArrays = 1u << 27;   ///< bytes of copies, where it is text
inline constexpr std::uint64_t kRepeatedArraysPerByte = 40;  ///< the same, more per byte of one

}  // namespace tenon::limits
