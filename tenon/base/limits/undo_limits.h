// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

/// Limits on what is kept to undo edits.
namespace tenon::limits {

inline constexpr std::size_t kUndoEdits = 100;             ///< of all assets of a user
inline constexpr std::size_t kUndoEditBytes = 67'108'864;  ///< of the files of one edit
inline constexpr std::size_t kUndoBytes = 268'435'456;     ///< of all edits that are kept

}  // namespace tenon::limits
