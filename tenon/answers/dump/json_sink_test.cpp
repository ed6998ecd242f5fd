// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/answers/dump/json_sink.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace tenon::answers {
namespace {

/// Values of all kinds, with strings that are no UTF-8 and some that are longer than a piece.
class RandomJson {
 public:
  Json make(int depth = 0) {
    switch (numbers_() % (depth > 5 ? 6 : 8)) {
      case 0:
        return nullptr;
      case 1:
        return numbers_() % 2 == 0;
      case 2:
        return std::ldexp(static_cast<double>(static_cast<std::int64_t>(numbers_())),
                          static_cast<int>(numbers_() % 80) - 70);
      case 3:
        return static_cast<std::int64_t>(numbers_());
      case 4:
        return text();
      case 5:
        return static_cast<double>(numbers_() % 10);
      case 6:
        return several(Json::array(), depth);
      default:
        return several(Json::object(), depth);
    }
  }

 private:
  std::string text() {
    std::string text;
    for (std::uint64_t left = numbers_() % 20; left > 0; --left) {
      text += static_cast<char>(numbers_() % 256);
    }
    return numbers_() % 50 == 0 ? text + std::string(70000, 'x') : text;
  }

  Json several(Json list, int depth) {
    for (std::uint64_t left = numbers_() % 6; left > 0; --left) {
      if (list.is_array()) {
        list.push_back(make(depth + 1));
      } else {
        list["\xff" + std::to_string(numbers_() % 100)] = make(depth + 1);
      }
    }
    return list;
  }

  std::mt19937_64 numbers_{1};
};

std::string in_pieces(const Json& value, int indent, bool only_ascii) {
  std::string text;
  {
    JsonTextSink sink(indent, only_ascii, [&](std::string_view piece) { text += piece; });
    sink.put(value);
  }
  return text;
}

TEST(JsonTextSink, TextInPiecesIsThatOfTheValue) {
  RandomJson random;
  for (int i = 0; i < 2000; ++i) {
    const Json value = random.make();
    for (const bool only_ascii : {false, true}) {
      EXPECT_EQ(in_pieces(value, 2, only_ascii) + "\n", printed(value, only_ascii));
      EXPECT_EQ(in_pieces(value, -1, only_ascii), on_one_line(value, only_ascii));
    }
  }
}

TEST(JsonTextSink, HoldsBackOnePiece) {
  std::size_t longest = 0;
  JsonTextSink sink(2, false,
                    [&](std::string_view piece) { longest = std::max(longest, piece.size()); });
  sink.begin_array();
  for (int i = 0; i < 100000; ++i) {
    sink.put(0.1);
  }
  sink.end_array();
  EXPECT_GT(longest, 10000u);
  EXPECT_LT(longest, 100000u);
}

TEST(JsonValueSink, MakesTheValue) {
  JsonValueSink sink;
  sink.begin_object();
  sink.key("a");
  sink.begin_array();
  sink.put(1);
  sink.begin_object();
  sink.end_object();
  sink.end_array();
  sink.key("b");
  sink.put(nullptr);
  sink.end_object();
  EXPECT_EQ(sink.take(), Json::parse(R"({"a": [1, {}], "b": null})"));
}

}  // namespace
}  // namespace tenon::answers
