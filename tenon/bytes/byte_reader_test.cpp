// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/byte_reader.h"

#include <gtest/gtest.h>

#include "tenon/bytes/byte_writer.h"
#include "tenon/bytes/test_bytes.h"

namespace tenon::bytes {
namespace {

TEST(ByteReader, ReadsWhatTheWriterWrote) {
  ByteWriter out;
  out.write(std::uint8_t{7});
  EXPECT_EQ(out.align(8), 8u);
  out.write(1.5);
  out.patch(0, std::uint8_t{9});
  ByteReader in(bytes_of(out.bytes()));
  EXPECT_EQ(*in.read<std::uint8_t>(), 9);
  ASSERT_TRUE(in.seek(8));
  EXPECT_EQ(*in.read<double>(), 1.5);
  EXPECT_EQ(in.remaining(), 0u);
}

TEST(ByteReader, RefusesToLeaveItsBytes) {
  const std::string text = "abcd";
  ByteReader in(bytes_of(text));
  EXPECT_FALSE(in.read<std::uint64_t>());
  EXPECT_FALSE(in.seek(5));
  EXPECT_TRUE(in.seek(4));
  EXPECT_FALSE(in.take(1));
  ASSERT_TRUE(in.seek(1));
  EXPECT_EQ(in.read<std::uint32_t>().error().code(), ErrorCode::Corrupt);
  EXPECT_EQ(in.offset(), 1u) << "a failed read moves nothing";
}

TEST(ByteReader, RefusesArraysThatAreNotThere) {
  const std::string text(16, '\0');
  ByteReader in(bytes_of(text));
  EXPECT_FALSE(in.read_array<std::uint64_t>(3));
  EXPECT_FALSE(in.read_array<std::uint64_t>(0x2000000000000001ull)) << "the product wraps to 8";
  EXPECT_EQ(in.read_array<std::uint64_t>(2)->size(), 2u);
  EXPECT_TRUE(in.read_array<std::uint64_t>(0));
}

}  // namespace
}  // namespace tenon::bytes
