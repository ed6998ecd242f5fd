// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/formats/crate/layout.h"

namespace tenon::fuzz {

using Column = std::vector<std::uint32_t>;

/// A crate file with its compressed tables plain, so that a change reaches what they mean. Counts
/// are written from the tables unless one is claimed.
struct CrateParts {
  std::uint8_t version[3] = {};
  std::string data;    ///< what stands between the first bytes and the first section
  std::string tokens;  ///< each ended by a zero
  std::uint64_t token_count = 0;
  Column strings;
  Column field_names;
  std::vector<formats::crate::ValueWord> field_words;
  Column field_sets;
  std::uint64_t path_count = 0;
  Column paths;
  Column path_tokens;
  Column path_jumps;
  Column spec_paths;
  Column spec_sets;
  Column spec_kinds;
  /// A wrong count, and the table that claims it: 0 tokens, 1 strings, 2 fields, 3 field sets,
  /// 4 paths, 5 specs.
  std::optional<std::uint64_t> claimed_count;
  unsigned claiming_table = 0;
};

/// Nothing when the file is damaged so that its tables cannot be read.
std::optional<CrateParts> take_apart(std::string_view crate);
std::string put_together(const CrateParts& parts);

/// Damages the file in one to four places, chosen by `seed`: its tables, values and packed arrays
/// when it can be taken apart, else bytes. At most `max_bytes` long.
std::string mutate_crate(std::string_view crate, std::uint64_t seed, std::size_t max_bytes);

}  // namespace tenon::fuzz
