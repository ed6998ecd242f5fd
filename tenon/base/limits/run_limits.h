// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

/// Limits on what a run may be asked for.
namespace tenon::limits {

/// States of bodies and joints that a run records, frames times bodies and joints: about 2 GB.
inline constexpr std::size_t kRecordedStates = 20'000'000;
inline constexpr std::size_t kRecordedContacts = 5'000'000;   ///< of a run: about 0.7 GB
inline constexpr std::size_t kCommandBytes = 268'435'456;     ///< of a file of commands
inline constexpr std::size_t kCommandValues = 20'000'000;     ///< numbers in a file of commands
inline constexpr std::size_t kStateBytes = 1'073'741'824;     ///< of a saved state that is read
inline constexpr std::uint64_t kRepeatedSteps = 2'000'000;    ///< to restore a state of a run
inline constexpr std::size_t kPythonOutput = 268'435'456;     ///< bytes that the package answers
inline constexpr std::size_t kStandardInput = 4'294'967'296;  ///< bytes of a layer from a pipe

}  // namespace tenon::limits
