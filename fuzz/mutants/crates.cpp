// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Crates that no writer makes: values that hold themselves, and many references to one large array.
#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fuzz/crate_parts.h"
#include "fuzz/mutants/mutant.h"
#include "tenon/formats/crate/writer.h"
#include "tenon/formats/open_layer.h"

namespace tenon::fuzz {
namespace {

using formats::crate::ValueWord;

constexpr std::size_t kBeforeData = 88;
constexpr unsigned kDictionary = 31;  // its number in files

/// An array of so many numbers, and small ones, dictionaries and samples.
std::string plain_layer(std::size_t numbers, std::size_t attributes) {
  std::string text = "#usda 1.0\n(\n    customLayerData = { dictionary a = { int b = 1 } }\n)\n";
  text +=
      "def Mesh \"A\" (\n    customData = { dictionary a = { dictionary b = { int c = 1 } } }\n)";
  text += "\n{\n    int[] big = [";
  for (std::size_t i = 0; i < numbers; ++i) {
    text += std::to_string(i * i % 9973) + ", ";
  }
  text += "1]\n    point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\n";
  text += "    double x.timeSamples = { 0: 1, 1: 2 }\n";
  text += "    int[] y.timeSamples = { 0: [1, 2], 1: [3] }\n";
  for (std::size_t i = 0; i < attributes; ++i) {
    text += "    int[] a" + std::to_string(i) + " = [" + std::to_string(i) + "]\n";
  }
  return text + "}\n";
}

std::string crate_with(const std::string& text) {
  Diagnostics diagnostics;
  const auto layer = formats::read_layer(bytes::FileBytes::own(text), "plain.usda", diagnostics);
  const auto crate = layer ? formats::write_crate(*layer) : Result<std::string>("");
  return crate ? *crate : "";
}

void write_number(std::string& bytes, std::size_t at, std::uint64_t number) {
  if (at + sizeof(number) <= bytes.size()) {
    std::memcpy(bytes.data() + at, &number, sizeof(number));
  }
}

/// Arrays are all the one that takes most bytes.
void share_arrays(CrateParts& parts, Dice& dice) {
  std::vector<ValueWord> arrays;
  for (const ValueWord word : parts.field_words) {
    if (word.is_array() && !word.is_inlined()) {
      arrays.push_back(word);
    }
  }
  std::sort(arrays.begin(), arrays.end(),
            [](ValueWord one, ValueWord other) { return one.payload() < other.payload(); });
  ValueWord largest;
  std::uint64_t most = 0;
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    const std::uint64_t end =
        i + 1 < arrays.size() ? arrays[i + 1].payload() : kBeforeData + parts.data.size();
    if (const std::uint64_t size = end - arrays[i].payload(); size > most) {
      most = size;
      largest = arrays[i];
    }
  }
  const bool others = dice.one_in(8);
  for (ValueWord& word : parts.field_words) {
    const bool same = word.type() == largest.type() && word.is_array();
    word = same || (others && dice.one_in(16)) ? largest : word;
  }
}

/// The first value in a dictionary is that dictionary.
void close_dictionaries(CrateParts& parts, Dice& dice) {
  for (const ValueWord word : std::vector<ValueWord>(parts.field_words)) {
    if (word.type() != kDictionary || word.is_inlined() || word.payload() < kBeforeData ||
        dice.one_in(4)) {
      continue;
    }
    const std::size_t offset = word.payload() - kBeforeData + 8 + 4;  // behind count and first key
    const std::size_t held = parts.data.size();
    parts.data.append(reinterpret_cast<const char*>(&word.bits), sizeof(word.bits));
    write_number(parts.data, offset, held - offset);
    if (dice.one_in(3)) {
      write_number(parts.data, offset - 12, dice.one_in(2) ? 1 : dice.extreme());
    }
  }
}

/// Some value holds, where it holds another one, the place of a field's value, perhaps its own.
void cross_values(CrateParts& parts, Dice& dice) {
  for (std::size_t left = 1 + dice.below(6); left > 0 && !parts.field_words.empty(); --left) {
    const ValueWord outer = parts.field_words[dice.below(parts.field_words.size())];
    const ValueWord inner =
        dice.one_in(2) ? outer : parts.field_words[dice.below(parts.field_words.size())];
    if (outer.is_inlined() || outer.payload() < kBeforeData) {
      continue;
    }
    const std::size_t at = outer.payload() - kBeforeData + dice.below(12) * 4;
    // A word, or how far it is to one.
    write_number(parts.data, at,
                 dice.one_in(2) ? inner.bits : 0 - std::uint64_t{8} * dice.below(8));
  }
}

/// Paths that lead back to themselves, specs that are all one.
void close_tables(CrateParts& parts, Dice& dice) {
  const auto value = static_cast<std::uint32_t>(dice.one_in(2) ? 0 - dice.below(4) : 1);
  for (Column* column : {&parts.path_jumps, &parts.paths, &parts.spec_paths, &parts.spec_sets}) {
    if (dice.one_in(2)) {
      const auto from = static_cast<std::ptrdiff_t>(dice.below(column->size() + 1));
      std::fill(column->begin() + from, column->end(), value);
    }
  }
}

}  // namespace

Mutant make_odd_crate(const Seeds&, Dice& dice) {
  const std::size_t what = dice.below(4);
  const std::size_t numbers = what == 0 ? 1 + dice.below(30'000) : dice.below(50);
  const std::size_t attributes = what == 0 ? dice.below(3000) : dice.below(20);
  const std::string crate = crate_with(plain_layer(numbers, attributes));
  std::string bytes = crate;
  if (std::optional<CrateParts> parts = take_apart(crate)) {
    constexpr void (*kDamages[])(CrateParts&, Dice&) = {share_arrays, close_dictionaries,
                                                        cross_values, close_tables};
    kDamages[what](*parts, dice);
    bytes = put_together(*parts);
  }
  if (dice.one_in(4)) {
    bytes = mutate_crate(bytes, dice.number(), kLargestMutant);
  }
  Mutant mutant;
  mutant.asset = "mutant.usdc";
  mutant.prim = "/A";
  mutant.bound = Bound::Arrays;
  mutant.files.push_back({mutant.asset, std::move(bytes)});
  return mutant;
}

}  // namespace tenon::fuzz
