// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/text/write/value_text.h"

#include <gtest/gtest.h>

namespace tenon::formats {
namespace {

struct Row {
  const char* type;
  const char* source;
  const char* canonical;  // nullptr: rejected
};

TEST(ValueText, ValuesOfAllTypesAreReadAndPrinted) {
  const Row rows[] = {
      {"bool", "yes", "1"},
      {"bool", "0", "0"},
      {"uchar", "255", "255"},
      {"uchar", "256", nullptr},
      {"int", "-2147483648", "-2147483648"},
      {"int", "1.9", "1"},
      {"uint", "4294967295", "4294967295"},
      {"int64", "-9223372036854775808", "-9223372036854775808"},
      {"uint64", "18446744073709551615", "18446744073709551615"},
      {"uint64", "-1", nullptr},
      {"half", "1.2345", "1.23438"},
      {"float", "0.1", "0.1"},
      {"float", "1e40", "inf"},
      {"double", "0.1", "0.1"},
      {"double", "1e400", "inf"},
      {"double", "9007199254740993", "9.007199254740992e15"},
      {"double", "-inf", "-inf"},
      {"double", "nan", "nan"},
      {"double", "abc", nullptr},
      {"string", "'a\"b'", "'a\"b'"},
      {"string", "\"a\\nb\"", "\"\"\"a\nb\"\"\""},
      {"string", "\"\\x41\\102\\t\"", "\"AB\\t\""},
      {"string", "\"\xC3\xA9\"", "\"\xC3\xA9\""},
      {"token", "\"x\"", "\"x\""},
      {"token", "x", nullptr},
      {"asset", "@a.usda@", "@a.usda@"},
      {"asset", "@@@a@b@@@", "@@@a@b@@@"},
      {"asset", "@@@a\\@@@b@@@", "@@@a\\@@@b@@@"},
      {"asset", "\"a\"", "@a@"},
      {"matrix2d", "((1, 2), (3, 4))", "( (1, 2), (3, 4) )"},
      {"quatf", "(1, 2, 3, 4)", "(1, 2, 3, 4)"},
      {"color3f", "(1, 0.5, 0)", "(1, 0.5, 0)"},
      {"int2", "(1, 2,)", "(1, 2)"},
      {"int2", "(1)", nullptr},
      {"timecode", "1.5", "1.5"},
      {"pathExpression", "\"//a*\"", "\"//a*\""},
      {"int[]", "[]", "[]"},
      {"int[]", "[[1, 2], [3, 4]]", "[1, 2, 3, 4]"},
      {"token[]", "[\"a\", \"b\"]", "[\"a\", \"b\"]"},
      {"float3[]", "[(1, 2, 3), (4, 5, 6)]", "[(1, 2, 3), (4, 5, 6)]"},
      {"int", "None", "None"},
      {"int", "1 2", nullptr},
      {"int", "", nullptr},
  };
  for (const Row& row : rows) {
    const layer::TypeName* type = layer::find_type_name(row.type);
    ASSERT_NE(type, nullptr) << row.type;
    const auto value = parse_value(row.source, *type);
    ASSERT_EQ(value.has_value(), row.canonical != nullptr) << row.type << ' ' << row.source;
    if (value) {
      EXPECT_EQ(value_text(*value), row.canonical) << row.type << ' ' << row.source;
    }
  }
}

TEST(ValueText, EveryTypeNameReadsWhatItPrints) {
  int checked = 0;
  for (const layer::TypeName& type : layer::all_type_names()) {
    if (type.type == layer::ValueType::Opaque || !type.is_array) {
      continue;
    }
    const auto empty = parse_value("[ ]", type);
    ASSERT_TRUE(empty) << type.name.str();
    EXPECT_EQ(value_text(*empty), "[]");
    EXPECT_EQ(empty->type(), type.type);
    ++checked;
  }
  EXPECT_GT(checked, 30);
}

}  // namespace
}  // namespace tenon::formats
