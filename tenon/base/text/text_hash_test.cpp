// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/text/text_hash.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace tenon {
namespace {

/// The most texts that share the bits of their hashes from `shift` on, in a table of `size`.
std::size_t fullest(const std::vector<std::string>& texts, unsigned shift, std::size_t size) {
  std::vector<std::size_t> counts(size);
  for (const std::string& text : texts) {
    ++counts[static_cast<std::size_t>(text_hash(text) >> shift) % size];
  }
  return *std::max_element(counts.begin(), counts.end());
}

// The text's address and the bytes after it do not matter.
TEST(TextHash, DependsOnTheTextAlone) {
  const std::string long_text = "primvars:displayColor:indices and more";
  for (std::size_t length = 0; length <= long_text.size(); ++length) {
    const std::string copy = long_text.substr(0, length);
    const std::string moved = "?" + copy + "!";
    EXPECT_EQ(text_hash(copy), text_hash(std::string_view(moved).substr(1, length))) << length;
  }
}

TEST(TextHash, EveryByteCounts) {
  for (const std::size_t length : {1u, 2u, 3u, 4u, 5u, 7u, 8u, 9u, 15u, 16u, 17u, 40u}) {
    std::set<std::uint64_t> hashes;
    std::string text(length, 'a');
    hashes.insert(text_hash(text));
    for (std::size_t i = 0; i < length; ++i) {
      for (unsigned bit = 0; bit < 8; ++bit) {
        std::string other = text;
        other[i] = static_cast<char>(other[i] ^ (1 << bit));
        hashes.insert(text_hash(other));
      }
    }
    EXPECT_EQ(hashes.size(), 1 + 8 * length) << length;
  }
}

// Tables take different bits of it: 100,000 names that differ in a number fill 4,096 places nearly
// alike, 24 each.
TEST(TextHash, NumberedNamesAreScattered) {
  std::vector<std::string> names;
  for (int i = 0; i < 100000; ++i) {
    names.push_back("body_" + std::to_string(i));
  }
  for (const unsigned shift : {0u, 8u, 32u, 40u, 52u}) {
    EXPECT_LT(fullest(names, shift, 4096), 60u) << shift;
  }
}

TEST(TextHash, ProductsAreTheSameInParts) {
  const std::uint64_t numbers[] = {0,
                                   1,
                                   0xFFFFFFFFu,
                                   0x100000000u,
                                   0x123456789ABCDEFu,
                                   0x9E3779B97F4A7C15u,
                                   0xD1B54A32D192ED03u,
                                   ~std::uint64_t{0}};
  for (const std::uint64_t a : numbers) {
    for (const std::uint64_t b : numbers) {
      EXPECT_EQ(folded_product(a, b), folded_product_in_parts(a, b)) << a << " " << b;
    }
  }
  EXPECT_EQ(folded_product(~std::uint64_t{0}, ~std::uint64_t{0}), ~std::uint64_t{0});
}

}  // namespace
}  // namespace tenon
