// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/gzip.h"

#include <gtest/gtest.h>

namespace tenon::bytes {
namespace {

TEST(SevenBitText, HasSevenBitsInACharacterTheHighestFirst) {
  EXPECT_EQ(seven_bit_text(""), "");
  EXPECT_EQ(seven_bit_text("\x82"), std::string("A\xc4\x80"));         // 1000001 0, filled up
  EXPECT_EQ(seven_bit_text("\x78"), std::string("\xc4\xbc\xc4\x80"));  // 0111100 is `<`
  EXPECT_EQ(seven_bit_text(std::string(7, '\xff')), std::string(8, '\x7f'));
}

TEST(SevenBitText, HasNothingThatHtmlChanges) {
  std::string bytes;
  for (int i = 0; i < 5000; ++i) {
    bytes += static_cast<char>(i * 37 % 251);
  }
  const std::string text = seven_bit_text(bytes);
  EXPECT_EQ(text.find_first_of(std::string("\0\r<", 3)), std::string::npos);
}

// RFC 1952, section 2.3: the magic numbers, deflate, no flags, no time; the size at the end.
TEST(Gzip, HasTheHeadAndTheSizeOfItsSpecification) {
  const std::string bytes(100'000, 'x');
  const auto packed = gzipped(bytes);
  ASSERT_TRUE(packed);
  ASSERT_GT(packed->size(), 18u);
  EXPECT_LT(packed->size(), 400u);
  EXPECT_EQ(packed->substr(0, 8), std::string("\x1f\x8b\x08\0\0\0\0\0", 8));
  EXPECT_EQ(packed->substr(packed->size() - 4), std::string("\xa0\x86\x01\0", 4));
}

TEST(Gzip, TakesNothing) { EXPECT_TRUE(gzipped("")); }

}  // namespace
}  // namespace tenon::bytes
