// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "fuzz/crate_parts.h"
#include "fuzz/dice.h"
#include "fuzz/text_mutations.h"
#include "tenon/bytes/byte_writer.h"
#include "tenon/bytes/integer_coding.h"

namespace tenon::fuzz {

using formats::crate::ValueWord;

void mutate_bytes(std::string& bytes, Dice& dice) {
  if (bytes.empty()) {
    bytes.push_back(static_cast<char>(dice.number()));
    return;
  }
  const std::size_t at = dice.below(bytes.size());
  switch (dice.below(6)) {
    case 0:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << dice.below(8)));
      break;
    case 1:
      bytes[at] = static_cast<char>(dice.number());
      break;
    case 2:
    case 3: {  // a number where numbers stand
      const std::size_t width = dice.one_in(2) ? 8 : 4;
      const std::uint64_t number = dice.one_in(3) ? dice.below(2 * bytes.size()) : dice.extreme();
      const std::size_t place = at / width * width;
      std::memcpy(bytes.data() + place, &number, std::min(width, bytes.size() - place));
      break;
    }
    case 4:
      bytes.erase(at, dice.below(16) + 1);
      break;
    default:
      bytes.insert(at, bytes.substr(dice.below(bytes.size()), dice.below(32) + 1));
      break;
  }
}

namespace {

void mutate_column(Column& column, Dice& dice) {
  if (column.empty()) {
    column.push_back(static_cast<std::uint32_t>(dice.extreme()));
    return;
  }
  std::uint32_t& row = column[dice.below(column.size())];
  switch (dice.below(7)) {
    case 0:
      row = static_cast<std::uint32_t>(dice.extreme());
      break;
    case 1:
      row += dice.one_in(2) ? 1 : ~0u;
      break;
    case 2:
      row = static_cast<std::uint32_t>(dice.below(column.size() + 2));
      break;
    case 3:
      row = column[dice.below(column.size())];
      break;
    case 4:
      row = 0 - row;
      break;
    case 5:
      column.insert(column.end(), 1 + dice.below(4), column[dice.below(column.size())]);
      break;
    default:
      column.erase(column.begin() + static_cast<std::ptrdiff_t>(dice.below(column.size())));
      break;
  }
}

void mutate_word(CrateParts& parts, Dice& dice) {
  if (parts.field_words.empty()) {
    return;
  }
  ValueWord& word = parts.field_words[dice.below(parts.field_words.size())];
  const ValueWord other = parts.field_words[dice.below(parts.field_words.size())];
  constexpr std::uint64_t kFlags = 0xff00000000000000ull;
  constexpr std::uint64_t kType = 0x00ff000000000000ull;
  switch (dice.below(7)) {
    case 0:
      word.bits = (word.bits & ~kType) | static_cast<std::uint64_t>(dice.below(64)) << 48;
      break;
    case 1:
      word.bits ^= 1ull << (60 + dice.below(4));
      break;
    case 2:
      word.bits = (word.bits & (kFlags | kType)) | other.payload();
      break;
    case 3:
      word.bits = (word.bits & (kFlags | kType)) | (88 + dice.below(parts.data.size() + 16));
      break;
    case 4:
      word.bits = (word.bits & (kFlags | kType)) | (dice.extreme() & ValueWord::kPayloadMask);
      break;
    case 5:
      word = other;
      break;
    default:
      word.bits ^= 1ull << dice.below(64);
      break;
  }
}

/// Replaces a packed array by one whose integers are others, at the end of the data.
void mutate_packed_array(CrateParts& parts, Dice& dice) {
  std::vector<std::size_t> packed;
  for (std::size_t i = 0; i < parts.field_words.size(); ++i) {
    if (parts.field_words[i].is_packed()) {
      packed.push_back(i);
    }
  }
  if (packed.empty()) {
    return;
  }
  ValueWord& word = parts.field_words[packed[dice.below(packed.size())]];
  Column integers(16 + dice.below(64));
  for (std::uint32_t& integer : integers) {
    integer = static_cast<std::uint32_t>(dice.one_in(4) ? dice.extreme() : dice.below(8));
  }
  const std::string coded = bytes::encode_integers(std::span<const std::uint32_t>(integers));
  bytes::ByteWriter out;
  out.write(dice.one_in(3) ? dice.extreme() : std::uint64_t{integers.size()});
  if (dice.one_in(2)) {
    const bool table = dice.one_in(2);
    out.write(table ? 't' : 'i');
    if (table) {
      out.write(std::uint32_t{8});
      out.write_text(std::string(32 + 32 * dice.below(2), '\1'));
    }
  }
  out.write(dice.one_in(6) ? dice.extreme() : std::uint64_t{coded.size()});
  out.write_text(coded);
  word.bits = (word.bits & ~ValueWord::kPayloadMask) | (88 + parts.data.size());
  parts.data += out.bytes();
}

/// More rows of one kind than the file had, as a hostile file would have them.
void repeat_rows(CrateParts& parts, Dice& dice) {
  const std::size_t times = std::size_t{1} << dice.below(12);
  if (dice.one_in(3) && !parts.field_sets.empty()) {
    const Column sets = parts.field_sets;
    for (std::size_t i = 0; i < times && parts.field_sets.size() < 100'000; ++i) {
      parts.field_sets.insert(parts.field_sets.end() - 1, sets.begin(), sets.end() - 1);
    }
  } else if (dice.one_in(2) && !parts.field_words.empty()) {
    const std::size_t row = dice.below(parts.field_words.size());
    parts.field_words.insert(parts.field_words.end(), times, parts.field_words[row]);
    parts.field_names.insert(parts.field_names.end(), times,
                             parts.field_names[row % parts.field_names.size()]);
  } else {
    for (Column* column : {&parts.spec_paths, &parts.spec_sets, &parts.spec_kinds}) {
      if (!column->empty()) {
        column->insert(column->end(), times, column->back());
      }
    }
  }
}

void mutate_parts(CrateParts& parts, Dice& dice) {
  Column* const columns[] = {&parts.strings,    &parts.field_names, &parts.field_sets,
                             &parts.paths,      &parts.path_tokens, &parts.path_jumps,
                             &parts.spec_paths, &parts.spec_sets,   &parts.spec_kinds};
  switch (dice.below(10)) {
    case 0:
    case 1:
      mutate_bytes(parts.data, dice);
      break;
    case 2:
    case 3:
      mutate_column(*columns[dice.below(std::size(columns))], dice);
      break;
    case 4:
    case 5:
      mutate_word(parts, dice);
      break;
    case 6:
      mutate_bytes(parts.tokens, dice);
      break;
    case 7:
      mutate_packed_array(parts, dice);
      break;
    case 8:
      repeat_rows(parts, dice);
      break;
    default:
      if (dice.one_in(2)) {
        parts.version[1] = static_cast<std::uint8_t>(4 + dice.below(13));
      } else {
        parts.claiming_table = static_cast<unsigned>(dice.below(6));
        parts.claimed_count = dice.extreme();
      }
      break;
  }
}

/// Once mostly, so that the rest of the file is still read.
std::size_t times(Dice& dice) { return dice.one_in(2) ? 1 : dice.below(4) + 1; }

}  // namespace

std::string mutate_crate(std::string_view crate, std::uint64_t seed, std::size_t max_bytes) {
  Dice dice(seed);
  std::string result(crate);
  const std::size_t left = times(dice);
  std::optional<CrateParts> parts = dice.one_in(5) ? std::nullopt : take_apart(crate);
  for (std::size_t i = 0; i < left; ++i) {
    if (parts) {
      mutate_parts(*parts, dice);
    } else {
      mutate_bytes(result, dice);
    }
  }
  if (parts) {
    result = put_together(*parts);
    if (dice.one_in(8)) {
      mutate_bytes(result, dice);
    }
  }
  if (result.size() > max_bytes) {
    result.resize(max_bytes);
  }
  return result;
}

}  // namespace tenon::fuzz
