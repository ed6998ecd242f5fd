// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/bytes/files.h"

namespace tenon::formats {

/// Columns in characters, that is in Unicode code points of UTF-8; 1-based, 0: unknown.
struct CharacterColumns {
  std::uint32_t column = 0;
  std::uint32_t end_column = 0;
};

/// The columns of findings, which are in bytes, in characters: (finding_count). Each file they
/// name is read again from `files`, in time linear in its size. Columns stay unknown where the file
/// has no such line any more, or is no file.
std::vector<CharacterColumns> character_columns(const std::vector<const Diagnostic*>& findings,
                                                const bytes::Files& files);

}  // namespace tenon::formats
