// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstring>
#include <random>
#include <utility>

#include "fuzz/crate_parts.h"
#include "tenon/bytes/byte_writer.h"
#include "tenon/bytes/integer_coding.h"

namespace tenon::fuzz {
namespace {

using formats::crate::ValueWord;

/// std::mt19937_64 is the same everywhere; the standard's distributions are not.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  std::uint64_t number() { return engine_(); }
  std::size_t below(std::size_t limit) { return limit == 0 ? 0 : engine_() % limit; }
  bool one_in(std::size_t n) { return below(n) == 0; }

  /// Numbers at which counts and offsets go wrong.
  std::uint64_t extreme() {
    static constexpr std::uint64_t kExtremes[] = {0,
                                                  1,
                                                  2,
                                                  0x7f,
                                                  0xff,
                                                  0x7fff,
                                                  0xffff,
                                                  0x10000,
                                                  0x7fffffff,
                                                  0x80000000,
                                                  0xfffffffe,
                                                  0xffffffff,
                                                  1ull << 32,
                                                  1ull << 40,
                                                  1ull << 48,
                                                  1ull << 60,
                                                  (1ull << 63) - 1,
                                                  1ull << 63,
                                                  ~0ull,
                                                  ~0ull - 7,
                                                  0x100000001};
    return kExtremes[below(std::size(kExtremes))];
  }

 private:
  std::mt19937_64 engine_;
};

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

constexpr std::string_view kNumbers[] = {"0",
                                         "-1",
                                         "1e308",
                                         "-1e308",
                                         "1e-320",
                                         "inf",
                                         "-inf",
                                         "nan",
                                         "2147483647",
                                         "-2147483648",
                                         "4294967295",
                                         "9223372036854775807",
                                         "-9223372036854775808",
                                         "18446744073709551615",
                                         "65504",
                                         "0.1",
                                         "1000000",
                                         "3"};
constexpr std::string_view kWords[] = {"{",
                                       "}",
                                       "(",
                                       ")",
                                       "[",
                                       "]",
                                       "<",
                                       ">",
                                       "=",
                                       ",",
                                       ";",
                                       ":",
                                       "@",
                                       "@@@",
                                       "\"",
                                       "'''",
                                       "\"\"\"",
                                       "\n",
                                       "\r\n",
                                       std::string_view("\0", 1),
                                       "\xef\xbb\xbf",
                                       "\xc3\x28",
                                       "\\",
                                       "#",
                                       "None",
                                       "def ",
                                       "over ",
                                       "class ",
                                       "\"A\"",
                                       "</A>",
                                       "</A{v=x}B>",
                                       "<../../..>",
                                       ".timeSamples",
                                       ".connect",
                                       ".spline",
                                       "references",
                                       "payload",
                                       "inherits",
                                       "specializes",
                                       "variantSet \"v\"",
                                       "variants",
                                       "subLayers",
                                       "relocates",
                                       "dictionary",
                                       "prepend ",
                                       "append ",
                                       "delete ",
                                       "add ",
                                       "reorder ",
                                       "1e400",
                                       "-inf",
                                       "nan",
                                       "0x7fffffff",
                                       "-9223372036854775809",
                                       "18446744073709551616",
                                       "1_000",
                                       "`${A}`",
                                       "matrix4d m = ((",
                                       "quath",
                                       "double3[]",
                                       "timecode",
                                       "pathExpression",
                                       "rel r",
                                       "uniform ",
                                       "custom ",
                                       "varying ",
                                       "offset = ",
                                       "scale = 0",
                                       "instanceable = true",
                                       "clips",
                                       "bezier",
                                       "loop repeat",
                                       "AnimationBlock"};

/// Start and length, line feed included, of the line that holds byte `at`.
std::pair<std::size_t, std::size_t> line_around(const std::string& text, std::size_t at) {
  const std::size_t before = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  const std::size_t start = before == std::string::npos ? 0 : before + 1;
  const std::size_t end = text.find('\n', at);
  return {start, (end == std::string::npos ? text.size() : end + 1) - start};
}

/// Lines left out, repeated and moved: most such texts still are layers.
void mutate_lines(std::string& text, Dice& dice) {
  const auto [from, length] = line_around(text, dice.below(text.size() + 1));
  const std::string line = text.substr(from, length);
  switch (dice.below(4)) {
    case 0:
      text.erase(from, length);
      break;
    case 1:
      text.insert(from, line);
      break;
    default:
      text.insert(line_around(text, dice.below(text.size() + 1)).first, line);
      break;
  }
}

/// A number or name of the text replaced by an extreme or by another of its own.
void mutate_literal(std::string& text, Dice& dice) {
  constexpr std::string_view kLiteral =
      "0123456789.-abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_:";
  const auto literal = [&](std::size_t near) {
    const std::size_t start = std::min(text.find_first_of(kLiteral, near), text.size());
    return std::pair(start, std::min(text.find_first_not_of(kLiteral, start), text.size()) - start);
  };
  const auto [at, length] = literal(dice.below(text.size() + 1));
  const auto [other, other_length] = literal(dice.below(text.size() + 1));
  const bool number = at < text.size() && text[at] <= '9';
  const std::string_view extreme = kNumbers[dice.below(std::size(kNumbers))];
  text.replace(at, length,
               number && dice.one_in(2) ? std::string(extreme) : text.substr(other, other_length));
}

void mutate_words(std::string& text, Dice& dice) {
  const std::size_t at = dice.below(text.size() + 1);
  const std::size_t from = dice.below(text.size() + 1);
  switch (dice.below(5)) {
    case 0:
    case 1:
      text.insert(at, kWords[dice.below(std::size(kWords))]);
      break;
    case 2:
      text.erase(at, dice.below(64));
      break;
    case 3:
      text.insert(at, text.substr(from, dice.below(256)));
      break;
    default: {  // repeated as a hostile file would have it
      const std::string piece = dice.one_in(2) ? text.substr(from, dice.below(24) + 1)
                                               : std::string(kWords[dice.below(std::size(kWords))]);
      const std::size_t times = std::size_t{1} << dice.below(13);
      std::string many;
      for (std::size_t i = 0; i < times; ++i) {
        many += piece;
      }
      text.insert(at, many);
      break;
    }
  }
}

/// Once mostly, so that the rest of the file is still read.
std::size_t times(Dice& dice) { return dice.one_in(2) ? 1 : dice.below(4) + 1; }

}  // namespace

std::string mutate_crate(std::string_view crate, std::uint64_t seed, std::size_t most_bytes) {
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
  if (result.size() > most_bytes) {
    result.resize(most_bytes);
  }
  return result;
}

std::string mutate_text(std::string_view text, std::uint64_t seed, std::size_t most_bytes) {
  Dice dice(seed);
  std::string result(text);
  for (std::size_t left = times(dice); left > 0; --left) {
    switch (dice.below(6)) {
      case 0:
        mutate_bytes(result, dice);
        break;
      case 1:
        mutate_words(result, dice);
        break;
      case 2:
      case 3:
        mutate_lines(result, dice);
        break;
      default:
        mutate_literal(result, dice);
        break;
    }
  }
  if (result.size() > most_bytes) {
    result.resize(most_bytes);
  }
  return result;
}

}  // namespace tenon::fuzz
