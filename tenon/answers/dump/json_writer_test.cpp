// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/answers/dump/json_writer.h"

#include <limits>
#include <sstream>

#include <gtest/gtest.h>

#include "tenon/base/sha256.h"

namespace tenon::answers {
namespace {

TEST(JsonWriter, NumbersReadAsPythonPrintsThem) {
  const struct {
    double value;
    const char* text;
  } cases[] = {{0, "0.0"},
               {-0.0, "-0.0"},
               {1, "1.0"},
               {0.1, "0.1"},
               {1e15, "1000000000000000.0"},
               {1e16, "1e+16"},
               {1e-4, "0.0001"},
               {1e-5, "1e-05"},
               {1.5e300, "1.5e+300"},
               {-2.25, "-2.25"},
               {double(0.1f), "0.10000000149011612"}};
  for (const auto& c : cases) {
    EXPECT_EQ(json_number(c.value), c.text);
  }
}

TEST(JsonWriter, TextIsEscaped) {
  EXPECT_EQ(json_quoted("a\"b\\c\n\t\x01\xC3\xA9"), "\"a\\\"b\\\\c\\n\\t\\u0001\xC3\xA9\"");
}

TEST(JsonWriter, NestingIsOneItemPerLine) {
  std::ostringstream out;
  {
    JsonWriter json(out);
    json.begin_object();
    json.key("a");
    json.begin_array();
    json.number(std::numeric_limits<double>::infinity());
    json.integer((std::int64_t{1} << 53) + 1);
    json.begin_object();
    json.end_object();
    json.end_array();
    json.key("b");
    json.null();
    json.end_object();
  }
  EXPECT_EQ(out.str(),
            "{\n \"a\": [\n  \"inf\",\n  \"9007199254740993\",\n  {}\n ],\n \"b\": null\n}");
}

TEST(Sha256, PublishedDigests) {
  const auto digest = [](std::string_view text) {
    Sha256 sha;
    sha.update(text);
    return sha.hex_digest();
  };
  EXPECT_EQ(digest(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(digest("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(digest("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST(JsonWriter, LongOutputArrivesWhole) {
  std::ostringstream out;
  {
    JsonWriter json(out);
    json.begin_array();
    for (int i = 0; i < 50000; ++i) {
      json.integer(i);
    }
    json.end_array();
  }
  const std::string text = out.str();
  EXPECT_EQ(text.substr(0, 8), "[\n 0,\n 1");
  EXPECT_EQ(text.substr(text.size() - 9), "\n 49999\n]");
}

}  // namespace
}  // namespace tenon::answers
