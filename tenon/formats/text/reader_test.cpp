// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/text/reader.h"

#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "tenon/base/limits/limits.h"
#include "tenon/formats/text/literals.h"

namespace tenon::formats {
namespace {

using layer::Layer;
using layer::ListOp;
using layer::Spec;
namespace fields = layer::fields;

Result<Layer> read(const std::string& body) {
  Diagnostics diagnostics;
  return read_text("#usda 1.0\n" + body, "t.usda", diagnostics);
}

/// The spec at `path` of a text that must be right.
Spec spec_of(const std::string& body, const char* path) {
  const auto layer = read(body);
  if (!layer) {
    ADD_FAILURE() << layer.error().to_string();
    return {};
  }
  const Spec* spec = layer->find(Path::from(path));
  EXPECT_NE(spec, nullptr) << path;
  return spec == nullptr ? Spec{} : *spec;
}

struct ErrorRow {
  const char* body;  // after the header line, so it starts at line 2
  std::uint32_t line;
  std::uint32_t column;
  const char* part;  // of the message
};

TEST(TextReader, ErrorsSayWhereAndWhatWasExpected) {
  const ErrorRow rows[] = {
      {"def \"A\"\n{\n}\n}\n", 5, 1,
       "expected def, over, class, reorder rootPrims or the end of the file, found '}'; an "
       "earlier '}' closed </A> at line 4"},
      {"def \"A\"\n{\n}\n    float a = 1\n", 5, 5, "found `float`; an earlier '}' closed </A>"},
      {"(\ndefaultPrim = \"W\"\n)\ndef \"W\" {\n}\ndef \"B\" {\n}\n)\n", 9, 1,
       "closed </B> at line 8, and another closed </W> at line 6"},
      {"def \"A\" {\n  def \"B\" (\n  )\n}\n", 5, 1,
       "expected '{' before the contents of </A/B>, declared at line 3, found '}'"},
      {"def \"A\" {\n", 3, 1, "or the '}' of </A>, found the end of the file"},
      {"def \"A\" {\n int a = x\n}\n", 3, 10, "expected a whole number, found `x`"},
      {"def \"A\" {\n int a = 3000000000\n}\n", 3, 10, "3000000000 does not fit"},
      {"def \"A\" {\n float3 a = (1, 2)\n}\n", 3, 13, "2 items where 3 are expected"},
      {"def \"A\" {\n float3 a = (1, 2, 3, 4)\n}\n", 3, 13, "more than 3 items"},
      {"def \"A\" {\n int[] a = 1\n}\n", 3, 12, "expected '[', as the type name ends with []"},
      {"def \"A\" {\n int a = [1]\n}\n", 3, 10, "expected a single value"},
      {"def \"A\" {\n int[] a = [[1, 2], [3]]\n}\n", 3, 21, "differ in size"},
      {"def \"A\" {\n string a = \"x\n}\n", 3, 13, "this string is not closed on its line"},
      {"def \"A\" {\n asset a = @x\n}\n", 3, 12, "this asset path is not closed on its line"},
      {"def \"A\" {\n rel a = </A\n}\n", 3, 10, "this path is not closed on its line"},
      {"def \"A\" {\n rel a = </A{v=x}B>\n}\n", 3, 10, "have no variant selections"},
      {"def \"A\" {\nvariantSet \"v\" = {\n\"x\" {\ndef \"B\" {\n rel a = <../C>\n}\n}\n}\n}\n", 6,
       10, "have no variant selections"},
      {"def \"A\" {\n rel a = [</A>, </A>]\n}\n", 3, 17, "this list names one item twice"},
      {"def \"A\" {\n int a\n float a\n}\n", 4, 2, "already has type int, not float"},
      {"def \"A\" {\n}\ndef \"A\" {\n}\n", 4, 5, "was already given at line 2"},
      {"def \"1a\" {\n}\n", 2, 5, "\"1a\" cannot name a prim"},
      {"def \"A\" (\n kind = 3\n) {\n}\n", 3, 9, "expected a string in quotes, found a number"},
      {"def \"A\" (\n specifier = \"x\"\n) {\n}\n", 3, 2, "is a field of its own"},
      {"def \"A\" (\n displayName = None\n) {\n}\n", 3, 2, "`displayName` cannot be None"},
      {"def \"A\" (\n add inherits = []\n) {\n}\n", 3, 17, "an empty list can only be set"},
      {"/* x\n", 2, 1, "this comment is never closed"},
      {"def \"A\" {\n varying int a\n}\n", 3, 10, "expected `rel`, found `int`"},
      {"def \"A\" {\n string a = \"\xff\"\n}\n", 3, 14, "this byte is not UTF-8"},
  };
  for (const ErrorRow& row : rows) {
    const auto layer = read(row.body);
    ASSERT_FALSE(layer) << row.body;
    const Diagnostic& found = layer.error().diagnostic();
    EXPECT_EQ(found.file, "t.usda");
    EXPECT_EQ(found.line, row.line) << row.body << layer.error().to_string();
    EXPECT_EQ(found.column, row.column) << row.body << layer.error().to_string();
    EXPECT_NE(found.message.find(row.part), std::string::npos) << row.part << "\nis not in\n"
                                                               << found.message;
  }
}

TEST(TextReader, HeadersAreChecked) {
  const std::pair<const char*, bool> rows[] = {{"#usda 1.0\n", true},
                                               {"#usda 1.0", true},
                                               {"#usda 1.4\n", true},
                                               {"#usda 1.0.32\r\n", true},
                                               {"#usda  1.1 x\n", true},
                                               {"#usda 1.5\n", false},
                                               {"#usda 2.0\n", false},
                                               {"#usda 1\n", false},
                                               {"#usda1.0\n", false},
                                               {"#sdf 1.4.32\n", false},
                                               {"", false},
                                               {"#usda 1.0foo\n", false},
                                               {"\xEF\xBB\xBF#usda 1.0\n", false}};
  for (const auto& [text, accepted] : rows) {
    Diagnostics diagnostics;
    EXPECT_EQ(read_text(text, "t.usda", diagnostics).has_value(), accepted) << text;
  }
}

TEST(TextReader, MetadataHaveTheTypesOfTheirFields) {
  const Spec root = spec_of(
      "(\n kilogramsPerUnit = 1\n upAxis = \"Z\"\n framePrecision = 2.5\n"
      " customLayerData = {int a = 1}\n)\n",
      "/");
  EXPECT_EQ(root.get_or(fields::kilogramsPerUnit, 0.0), 1.0);
  EXPECT_EQ(root.get_or(fields::upAxis, Token()), "Z");
  EXPECT_EQ(root.get_or(fields::framePrecision, 0), 2);
  EXPECT_NE(root.get<layer::Dictionary>(fields::customLayerData), nullptr);
}

TEST(TextReader, UnknownMetadataAreKeptAsText) {
  const Spec prim =
      spec_of("def \"A\" (\n x = [1.50,  'a']\n prepend y = [1]\n z = {int a = 1}\n) {\n}\n", "/A");
  const auto* x = prim.get<layer::UnregisteredValue>("x");
  ASSERT_NE(x, nullptr);
  EXPECT_EQ(x->value.get_or(std::string()), "[1.5, \"a\"]");
  const auto* y = prim.get<layer::UnregisteredValue>("y");
  ASSERT_NE(y, nullptr);
  EXPECT_TRUE(y->value.holds<ListOp<layer::UnregisteredValue>>());
  const auto* z = prim.get<layer::UnregisteredValue>("z");
  ASSERT_NE(z, nullptr);
  EXPECT_TRUE(z->value.holds<layer::Dictionary>());
}

TEST(TextReader, ListEditsAreCollected) {
  const Spec prim = spec_of(
      "def \"A\" (\n prepend references = @a@\n append references = [@b@</B>, </C>]\n"
      " delete apiSchemas = [\"X\"]\n inherits = <../B>\n) {\n}\n",
      "/A");
  const auto* references = prim.get<ListOp<layer::Reference>>(fields::references);
  ASSERT_NE(references, nullptr);
  ASSERT_EQ(references->prepended.size(), 1u);
  ASSERT_EQ(references->appended.size(), 2u);
  EXPECT_EQ(references->appended[0].asset_path, "b");
  EXPECT_EQ(references->appended[1].prim_path, Path::from("/C"));
  const auto* schemas = prim.get<ListOp<Token>>(fields::apiSchemas);
  ASSERT_NE(schemas, nullptr);
  EXPECT_EQ(schemas->deleted, std::vector<Token>{"X"});
  const auto* inherits = prim.get<ListOp<Path>>(fields::inheritPaths);
  ASSERT_NE(inherits, nullptr);
  EXPECT_EQ(inherits->explicit_items, std::vector<Path>{Path::from("/B")});
}

TEST(TextReader, OnlyTheVariantAroundARelativePathIsNoLevelOfIt) {
  const auto within = [](const std::string& line) {
    return "def \"A\" {\nvariantSet \"v\" = {\n\"x\" {\ndef \"B\" {\nvariantSet \"w\" = {\n\"y\" "
           "{\n" +
           line + "\n}\n}\n}\n}\n}\n}\n";
  };
  const std::string body = within("rel to = <../../C>\ndouble a.connect = <../C.a>");
  const auto items = [&](const char* path, Token field) {
    return spec_of(body, path).get<ListOp<Path>>(field)->explicit_items;
  };
  using Paths = std::vector<Path>;
  EXPECT_EQ(items("/A{v=x}B{w=y}.to", fields::targetPaths), Paths{Path::from("/A/C")});
  EXPECT_EQ(items("/A{v=x}B{w=y}.a", fields::connectionPaths), Paths{Path::from("/A/C.a")});
  Diagnostics diagnostics;
  EXPECT_FALSE(read_text("#usda 1.0\n" + within("rel to = <../C>"), "test", diagnostics));
}

TEST(TextReader, RelativePathsInVariantsLeadOutOfThem) {
  const std::string body =
      "def \"A\" {\nvariantSet \"v\" = {\n\"x\" {\n rel own = <C>\ndef \"B\" (inherits = "
      "<../../K>) "
      "{\n rel to = <../../C>\n double a.connect = [<../C.a>, <../../../C.a>]\n}\n}\n}\n}\n";
  const auto items = [&](const char* path, Token field) {
    return spec_of(body, path).get<ListOp<Path>>(field)->explicit_items;
  };
  using Paths = std::vector<Path>;
  EXPECT_EQ(items("/A{v=x}.own", fields::targetPaths), Paths{Path::from("/A/C")});
  EXPECT_EQ(items("/A{v=x}B.to", fields::targetPaths), Paths{Path::from("/A/C")});
  EXPECT_EQ(items("/A{v=x}B", fields::inheritPaths), Paths{Path::from("/A/K")});
  EXPECT_EQ(items("/A{v=x}B.a", fields::connectionPaths),
            (Paths{Path::from("/A/C.a"), Path::from("/C.a")}));
}

/// `count` points (i, 0.5, -i), with what `at(i)` gives in front of each.
template <class Front>
std::string point_list(int count, Front at) {
  std::string text = "def \"A\" {\n float3[] p = [";
  for (int i = 0; i < count; ++i) {
    text += i == 0 ? "" : ", ";
    text += at(i);
    text += '(' + std::to_string(i) + ", 5e-1, -" + std::to_string(i) + ".0)";
  }
  return text + "]\n}\n";
}

void expect_points(const std::string& body, std::size_t count) {
  const Spec spec = spec_of(body, "/A.p");
  const auto* points = spec.get<layer::Array<Vec3f>>(fields::default_value);
  ASSERT_NE(points, nullptr);
  ASSERT_EQ(points->size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<float>(i);
    ASSERT_EQ((*points)[i], (Vec3f{{x, 0.5f, -x}})) << i;
  }
}

TEST(TextReader, LongListsAreReadHoweverTheyAreWritten) {
  const auto plain = [](int) { return ""; };
  expect_points(point_list(100, plain), 100);
  expect_points(point_list(100000, plain), 100000);  // more than a megabyte: in two halves
  const auto comment = [](int i) { return i % 7001 == 7000 ? "/* ), ( ] */ " : ""; };
  expect_points(point_list(200, [](int i) { return i == 150 ? "# ]\n" : "\n\t"; }), 200);
  expect_points(point_list(100000, comment), 100000);
  std::string trailing = point_list(100, plain);
  trailing.replace(trailing.find(']', 20), 1, ", ]");
  expect_points(trailing, 100);
}

TEST(TextReader, LongListsKeepTheirFaultsAndTheirPlaces) {
  std::string wrong = point_list(100000, [](int) { return "\n"; });
  wrong.replace(wrong.find("(60000,"), 7, "(60000;");
  const auto layer = read(wrong);
  ASSERT_FALSE(layer);
  EXPECT_EQ(layer.error().diagnostic().line, 60004u);
  EXPECT_EQ(layer.error().diagnostic().column, 7u);
  EXPECT_FALSE(read("def \"A\" {\n int[] a = [1, 2, 3 4]\n}\n"));
  EXPECT_FALSE(read("def \"A\" {\n int[] a = [1, 2\n, 3]\n}\n"));
  EXPECT_FALSE(read("def \"A\" {\n int[] a = [1, 2, 3000000000, 4]\n}\n"));
  EXPECT_FALSE(read("def \"A\" {\n int[] a = [1, 2, [3], 4]\n}\n"));
}

TEST(TextReader, NumbersOfListsAreThoseOfSingleValues) {
  for (const char* number : {"1", "-0", ".5", "-3.", "1e3", "1E-3", "0.1", "123456789012345678901",
                             "1.7976931348623157e308", "1e999", "4.9e-324", "0.30000000000000004",
                             "9007199254740993", "inf", "-inf"}) {
    const std::string one = std::string("def \"A\" {\n double p = ") + number + "\n}\n";
    const std::string list = std::string("def \"A\" {\n double[] p = [") + number + ", 1]\n}\n";
    const double single = spec_of(one, "/A.p").get_or(fields::default_value, 0.25);
    const Spec listed = spec_of(list, "/A.p");
    const auto* numbers = listed.get<layer::Array<double>>(fields::default_value);
    ASSERT_NE(numbers, nullptr);
    EXPECT_EQ((*numbers)[0], single) << number;
    EXPECT_EQ(std::signbit((*numbers)[0]), std::signbit(single)) << number;
  }
}

TEST(TextReader, SpecsThatShareFieldsStaySeparate) {
  const std::string body =
      "def \"A\" {\n int p = 1\n}\ndef \"B\" {\n int p = 1\n int p.connect = </A.p>\n}\n"
      "def \"C\" {\n int p = 1\n}\ndef \"D\" {\n int p = 1\n}\n";
  EXPECT_FALSE(spec_of(body, "/A.p").has(fields::connectionPaths));
  EXPECT_TRUE(spec_of(body, "/B.p").has(fields::connectionPaths));
  EXPECT_FALSE(spec_of(body, "/C.p").has(fields::connectionPaths));
  const auto layer = read(body);
  const auto& third = layer->find(Path::from("/C.p"))->field_list();
  EXPECT_TRUE(third.is_same(layer->find(Path::from("/D.p"))->field_list()));
  EXPECT_EQ(layer->find(Path::from("/C.p"))->line, 10u);
}

TEST(TextReader, AttributesHaveValuesSamplesAndPlaces) {
  const std::string body =
      "def \"A\" {\n  float3[] p = [(1, 2, 3),\n (4, 5, 6)]\n"
      "  custom uniform bool b = no\n  double t.timeSamples = {2: 1, 1: None, 2: 3}\n}\n";
  const Spec points = spec_of(body, "/A.p");
  const auto* values = points.get<layer::Array<Vec3f>>(fields::default_value);
  ASSERT_NE(values, nullptr);
  EXPECT_EQ((*values)[1], (Vec3f{{4, 5, 6}}));
  EXPECT_EQ(points.line, 3u);
  EXPECT_EQ(points.column, 3u);
  const Spec flag = spec_of(body, "/A.b");
  EXPECT_TRUE(flag.get_or(fields::custom, false));
  EXPECT_EQ(flag.get_or(fields::variability, layer::Variability::Varying),
            layer::Variability::Uniform);
  EXPECT_FALSE(flag.get_or(fields::default_value, true));
  const Spec animated = spec_of(body, "/A.t");
  const auto* samples = animated.get<layer::TimeSamples>(fields::timeSamples);
  ASSERT_NE(samples, nullptr);
  EXPECT_EQ(samples->times, (std::vector<double>{1, 2}));
  EXPECT_TRUE(samples->values[0].is_block());
  EXPECT_EQ(samples->values[1].get_or(0.0), 3.0);
}

// OpenUSD rejects the second sample (CONFORMANCE.md).
TEST(TextReader, SamplesOfAnUnknownTypeAreReadLikeTheFirst) {
  const Spec spec =
      spec_of("def \"A\" {\n uint2 a.timeSamples = {\n 0: (1, 2),\n 1: (3, 4),\n }\n}\n", "/A.a");
  const auto* samples = spec.get<layer::TimeSamples>("timeSamples");
  ASSERT_NE(samples, nullptr);
  EXPECT_EQ(samples->times, (std::vector<double>{0, 1}));
}

TEST(TextReader, ChildrenKeepTheirOrder) {
  const auto layer = read(
      "def \"B\" {\n}\ndef \"A\" {\n int z\n int a\n variantSet \"v\" = {\n \"y\" {\n def \"C\" {\n"
      "}\n}\n \"x\" {\n}\n}\n}\n");
  ASSERT_TRUE(layer) << layer.error().to_string();
  const Path a = Path::from("/A");
  EXPECT_EQ(Layer::children(layer->root(), fields::primChildren), (std::vector<Token>{"B", "A"}));
  EXPECT_EQ(layer->children(a, fields::properties), (std::vector<Token>{"z", "a"}));
  EXPECT_EQ(layer->children(a, fields::variantSetChildren), (std::vector<Token>{"v"}));
  EXPECT_EQ(layer->children(a.variant_selection("v", Token()), fields::variantChildren),
            (std::vector<Token>{"y", "x"}));
  EXPECT_TRUE(layer->has(a.variant_selection("v", "y").child("C")));
}

TEST(TextReader, NestingHasALimitAndNoCrash) {
  std::string prims;
  std::string dictionaries = "(\n customLayerData = ";
  std::string lists = "(\n a = ";
  for (std::size_t i = 0; i < limits::kTextNestingDepth + 10; ++i) {
    prims += "def \"A\" {\n";
    dictionaries += "{dictionary a = ";
    lists += "[(";
  }
  for (const std::string& body : {prims, dictionaries, lists}) {
    const auto layer = read(body);
    ASSERT_FALSE(layer);
    EXPECT_EQ(layer.error().code(), ErrorCode::Limit) << layer.error().to_string();
  }
}

TEST(TextReader, RepeatedItemsOfMetadataListsAreReported) {
  Diagnostics diagnostics;
  const auto layer = read_text("#usda 1.0\ndef \"A\" (\n apiSchemas = [\"X\", \"X\"]\n) {\n}\n",
                               "t.usda", diagnostics);
  ASSERT_TRUE(layer);
  ASSERT_EQ(diagnostics.size(), 1u);
  EXPECT_EQ(diagnostics.items()[0].line, 3u);
  EXPECT_FALSE(layer->find(Path::from("/A"))->has(fields::apiSchemas));
}

TEST(TextReader, NumbersOfAnyLengthAreReadAsTheCLibraryReadsThem) {
  std::mt19937 numbers(3);
  const auto dice = [&] { return static_cast<std::uint32_t>(numbers()); };
  const auto digits = [&](std::uint32_t count, bool zeros) {
    std::string some;
    for (std::uint32_t i = 0; i < count; ++i) {
      some += zeros && dice() % 2 == 0 ? '0' : static_cast<char>('0' + dice() % 10);
    }
    return some;
  };
  int plain = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string number = dice() % 4 == 0 ? "-" : "";
    number += digits(dice() % 24, dice() % 3 == 0);
    number += dice() % 2 == 0 ? "." + digits(1 + dice() % 24, dice() % 3 == 0) : "";
    number += dice() % 8 == 0 ? "e" + std::to_string(static_cast<int>(dice() % 40) - 20) : "";
    const std::string_view ends[] = {"", ",", ")", " 12345678", "]]]]]]]]", ", 0.5, 0.25"};
    const std::string whole = number + std::string(ends[dice() % std::size(ends)]);
    const char* at = whole.data();
    double value = 0;
    if (!text::take_plain_double(at, whole.data() + whole.size(), value)) {
      continue;  // left to the reader that tells faults
    }
    ++plain;
    char* end = nullptr;
    EXPECT_EQ(value, std::strtod(whole.c_str(), &end)) << whole;
    EXPECT_EQ(at, end) << whole;
  }
  EXPECT_GT(plain, 10000);
}

}  // namespace
}  // namespace tenon::formats
