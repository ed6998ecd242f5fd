// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/integer_coding.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "tenon/bytes/lz4_block.h"
#include "tenon/bytes/test_bytes.h"

namespace tenon::bytes {
namespace {

template <class T>
void expect_round_trip(const std::vector<T>& integers) {
  const std::string packed = encode_integers<T>(integers);
  const auto back = decode_integers<T>(bytes_of(packed), integers.size());
  ASSERT_TRUE(back) << back.error().to_string();
  EXPECT_EQ(*back, integers);
}

TEST(IntegerCoding, GivesBackWhatWasPacked) {
  expect_round_trip<std::int32_t>({});
  expect_round_trip<std::int32_t>({5});
  expect_round_trip<std::int32_t>({123, 124, 125, 100125, 100125, 100126, 100126});
  expect_round_trip<std::int32_t>({std::numeric_limits<std::int32_t>::min(),
                                   std::numeric_limits<std::int32_t>::max(), 0, -1, 1});
  expect_round_trip<std::uint32_t>({0, 0xffffffffu, 1, 0x80000000u, 0x7fffffffu});
  expect_round_trip<std::int64_t>({std::numeric_limits<std::int64_t>::min(),
                                   std::numeric_limits<std::int64_t>::max(), 0, 70000, -70000});
  expect_round_trip<std::uint64_t>({0, ~0ull, 1, 1ull << 63});
  std::vector<std::int32_t> longer;
  for (int i = 0; i < 1003; ++i) {
    longer.push_back(i * i % 257 - 40 * (i % 3));
  }
  expect_round_trip(longer);
}

// The worked example of the format: commonest difference 1, codes 01 00 00 11 | 01 00 01, then
// 123 in one byte, 100000 in four, 0 and 0 in one each.
TEST(IntegerCoding, PacksAsTheFormatSays) {
  const std::string packed = encode_integers<std::int32_t>(
      std::vector<std::int32_t>{123, 124, 125, 100125, 100125, 100126, 100126});
  const auto plain = lz4_decompress(bytes_of(packed), 100);
  ASSERT_TRUE(plain);
  const std::string expected("\x01\0\0\0\xC1\x11\x7B\xA0\x86\x01\0\0\0", 13);
  EXPECT_EQ(*plain, expected);
}

TEST(IntegerCoding, GivesBackLongListsOfAnyStep) {
  for (const std::size_t count : {511u, 512u, 514u, 4099u}) {
    for (const std::int64_t step : {0ll, 1ll, -3ll, 127ll, 40000ll, -70000ll, 1ll << 33}) {
      std::vector<std::int64_t> wide;
      std::vector<std::int32_t> narrow;
      for (std::size_t i = 0; i < count; ++i) {
        const std::int64_t jump = i % 97 == 5 ? step * 11 - 2049 : 0;
        wide.push_back(static_cast<std::int64_t>(i) * step + jump);
        narrow.push_back(static_cast<std::int32_t>(wide.back() % 1000003));
      }
      expect_round_trip(wide);
      expect_round_trip(narrow);
    }
  }
}

// Of differences that are equally common the largest counts, in short lists and in long ones.
TEST(IntegerCoding, TheLargestOfTheCommonestDifferencesIsLeftOut) {
  for (const std::size_t rounds : {5u, 500u, 5000u}) {
    std::vector<std::int32_t> integers{-7};
    for (std::size_t i = 0; i < rounds; ++i) {
      for (const std::int32_t difference : {-7, 5000, -5000, 4000, 1}) {
        integers.push_back(integers.back() + difference);
      }
    }
    integers.push_back(integers.back() + 5000);
    const auto plain = lz4_decompress(bytes_of(encode_integers<std::int32_t>(integers)), 1000000);
    ASSERT_TRUE(plain);
    std::int32_t common = 0;
    std::memcpy(&common, plain->data(), sizeof(common));
    EXPECT_EQ(common, 5000);
  }
}

// Lists are long enough that differences are not compared one with another.
TEST(IntegerCoding, LeavesOutWhatAPlainCountFinds) {
  std::mt19937 random(11);
  for (const std::uint32_t kinds : {3u, 50u, 20000u}) {
    std::vector<std::uint32_t> steps(kinds);
    for (std::uint32_t& step : steps) {
      step = static_cast<std::uint32_t>(random());
    }
    std::vector<std::uint32_t> integers;
    std::map<std::int32_t, std::size_t> counts;
    std::uint32_t last = 0;
    for (int i = 0; i < 20000; ++i) {
      const std::uint32_t step = steps[random() % kinds];
      ++counts[static_cast<std::int32_t>(step)];
      integers.push_back(last += step);
    }
    const auto expected =
        std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) {
          return a.second != b.second ? a.second < b.second : a.first < b.first;
        });
    const auto plain = lz4_decompress(bytes_of(encode_integers<std::uint32_t>(integers)), 1000000);
    ASSERT_TRUE(plain);
    std::int32_t common = 0;
    std::memcpy(&common, plain->data(), sizeof(common));
    EXPECT_EQ(common, expected->first);
    expect_round_trip(integers);
  }
}

TEST(IntegerCoding, RefusesMoreThanTheDataHold) {
  const std::vector<std::int32_t> integers(100, 3);
  const std::string packed = encode_integers<std::int32_t>(integers);
  EXPECT_FALSE(decode_integers<std::int32_t>(bytes_of(packed), 105));
  EXPECT_FALSE(decode_integers<std::int32_t>(bytes_of(packed), 1ull << 62));
  EXPECT_FALSE(decode_integers<std::int32_t>({}, 1));
  const std::string tail_missing = lz4_compress(bytes_of(std::string("\0\0\0\0\xFF", 5)));
  EXPECT_FALSE(decode_integers<std::int32_t>(bytes_of(tail_missing), 4));
}

TEST(Lz4Block, RefusesDamagedData) {
  const std::string packed = lz4_compress(bytes_of(std::string(1000, 'x')));
  EXPECT_EQ(lz4_decompress(bytes_of(packed), 1000)->size(), 1000u);
  EXPECT_FALSE(lz4_decompress(bytes_of(packed), 999));
  EXPECT_FALSE(lz4_decompress(bytes_of(packed.substr(0, packed.size() - 1)), 1000));
  EXPECT_FALSE(lz4_decompress({}, 1000));
  EXPECT_FALSE(lz4_decompress(bytes_of(std::string("\x02\xFF\xFF\xFF\x7F", 5)), 1000));
}

TEST(Lz4Block, ReadsSeveralChunks) {
  const std::string one = lz4_compress(bytes_of(std::string("first"))).substr(1);
  std::string chunks("\x02", 1);
  for (int i = 0; i < 2; ++i) {
    chunks += static_cast<char>(one.size());
    chunks += std::string(3, '\0') + one;
  }
  EXPECT_EQ(*lz4_decompress(bytes_of(chunks), 100), "firstfirst");
}

}  // namespace
}  // namespace tenon::bytes
