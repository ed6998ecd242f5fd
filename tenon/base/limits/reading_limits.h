// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

/// Limits on which files an asset may have read, and how much of them.
namespace tenon::limits {

inline constexpr std::uint64_t kCopiedFileBytes = 4'294'967'296;  ///< of a file that is copied
inline constexpr std::uint64_t kCheckedEntryBytes = 1u << 20;     ///< whose check sum reading takes
inline constexpr std::size_t kPartsFolderLevels = 4;    ///< above the folder of a description
inline constexpr std::size_t kPythonPackageLevels = 8;  ///< from it to a description's folder
inline constexpr std::size_t kNamedFiles = 100'000;     ///< names that a model's files are tried by
inline constexpr std::size_t kReplicatedElements = 10'000;   ///< made by <replicate>, <flexcomp>
inline constexpr std::uint64_t kPackageXmlBytes = 1u << 20;  ///< of a ROS package's package.xml
inline constexpr std::size_t kSdfModels = 10'000;  ///< of an SDF file, nested and included
inline constexpr std::size_t kSdfNodes = 200'000;  ///< links, joints, frames, models in it
inline constexpr std::size_t kSdfDepth = 32;       ///< models within models
inline constexpr std::uint64_t kSdfIncludedBytes = 1u << 28;  ///< of the files that it includes
inline constexpr std::uint64_t kSettingsBytes = 1u << 14;     ///< of a tenon.toml
inline constexpr std::size_t kSettingsDepth = 8;              ///< tables within tables in it
inline constexpr std::uint64_t kJsonFileBytes = 1u << 26;     ///< of baselines and files of gains
inline constexpr std::size_t kSceneJson = 1u << 28;           ///< bytes of a physics scene as JSON

}  // namespace tenon::limits
