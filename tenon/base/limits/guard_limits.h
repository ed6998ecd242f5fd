// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

/// What the process may ask for that reads formats by libraries of others, beside those of
/// tenon/base/limits/limits.h.
namespace tenon::limits {

inline constexpr std::uint64_t kGuardMemoryBase = 1u << 30;      ///< bytes for any file
inline constexpr std::uint64_t kGuardMemoryPerByte = 40;         ///< more per byte of the file
inline constexpr std::uint64_t kGuardMemoryMax = 8'589'934'592;  ///< bytes for the largest file
inline constexpr std::uint64_t kGuardSeconds = 5;                ///< of processor time of a command
inline constexpr std::uint64_t kGuardBytesPerSecond = 1u
                                                      << 20;  ///< a second more for each of these
inline constexpr std::uint64_t kGuardWallSeconds = 60;        ///< until an answer is there
inline constexpr std::uint64_t kGuardReplyBase = 256u << 20;  ///< bytes of an answer
inline constexpr std::uint64_t kGuardReplyPerByte = 40;       ///< more per byte of the file
inline constexpr std::size_t kGuardFindings = 10'000;         ///< findings about one file
inline constexpr std::size_t kGuardRoots = 256;               ///< folders that may be read
inline constexpr std::size_t kGuardLosses = 5;           ///< processes that one command may lose
inline constexpr std::uint64_t kXacroMemory = 1u << 30;  ///< bytes for the macros of a file
inline constexpr std::uint64_t kXacroSeconds = 20;       ///< of processor time for the same
inline constexpr int kXacroWallSeconds = 60;             ///< until they are expanded
inline constexpr std::size_t kXacroBytes = 67'108'864;   ///< of the expanded text
inline constexpr std::size_t kXacroPackages = 32;        ///< that a file asks for and nobody named
inline constexpr std::size_t kGuardOpenFiles = 64;       ///< files that are open at once

}  // namespace tenon::limits
