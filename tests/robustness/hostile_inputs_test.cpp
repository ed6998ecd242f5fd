// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Small files that ask for much: each is read within its allowance of memory and without having to
// be ended, or refused with an error that names file and place. Files of regular growth are read
// with work that grows as they do.
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "fuzz/crate_parts.h"
#include "tenon/base/limits/crate_limits.h"
#include "tenon/base/limits/limits.h"
#include "tenon/bytes/byte_writer.h"
#include "tenon/bytes/integer_coding.h"
#include "tenon/formats/crate/writer.h"
#include "tenon/formats/open_layer.h"
#include "tenon/layer/field_values.h"
#include "tests/robustness/measured_child.h"
#include "tests/robustness/open_input.h"

namespace tenon::robustness {
namespace {

std::string repeated(const std::string& piece, std::size_t times) {
  std::string text;
  text.reserve(piece.size() * times);
  for (std::size_t i = 0; i < times; ++i) {
    text += piece;
  }
  return text;
}

/// `count` pieces made from their number.
std::string numbered(std::size_t count,
                     const std::function<std::string(const std::string&)>& piece) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    text += piece(std::to_string(i));
  }
  return text;
}

const std::string kHeader = "#usda 1.0\n";

enum class Expected { Refused, Accepted, Either };

void expect_bounded(const std::string& bytes, Expected expected) {
  const Allowance allowance = allowance_of(bytes.size());
  const Cost cost = measure([&] { return read_input(bytes); }, allowance);
  EXPECT_EQ(cost.excess(allowance, Cost::Judge::Hang), "");
  if (expected != Expected::Either) {
    EXPECT_EQ(cost.outcome == kRefused, expected == Expected::Refused);
  }
}

void expect_composes(const std::string& bytes) {
  Allowance allowance = allowance_of(bytes.size());
  allowance.seconds *= 10;
  allowance.bytes *= 8;
  const Cost cost = measure([&] { return compose_input(bytes); }, allowance);
  EXPECT_EQ(cost.excess(allowance, Cost::Judge::Hang), "");
  EXPECT_EQ(cost.outcome, kComposed);
}

void expect_error_at(const std::string& text, ErrorCode code, std::uint32_t line) {
  Diagnostics diagnostics;
  const auto layer = formats::read_layer(bytes::FileBytes::own(text), "hostile.usda", diagnostics);
  ASSERT_FALSE(layer);
  EXPECT_EQ(layer.error().code(), code) << layer.error().to_string();
  EXPECT_EQ(layer.error().diagnostic().file, "hostile.usda");
  EXPECT_EQ(layer.error().diagnostic().line, line);
  EXPECT_GT(layer.error().diagnostic().column, 0u);
}

TEST(HostileText, PrimsAHundredThousandLevelsDeep) {
  const std::string text = kHeader + repeated("def \"A\" {\n", 100'000);
  expect_bounded(text, Expected::Refused);
  expect_error_at(text, ErrorCode::Limit, 1002);
}

TEST(HostileText, DictionariesAHundredThousandLevelsDeep) {
  const std::string text =
      kHeader + "(\n    customLayerData = {\n" + repeated("dictionary d = {\n", 100'000);
  expect_bounded(text, Expected::Refused);
  expect_error_at(text, ErrorCode::Limit, 1003);
}

TEST(HostileText, LimitsNameTheirPlace) {
  const auto numbers = [](std::size_t count, const char* start, const char* end) {
    return numbered(count, [&](const std::string& n) { return start + n + end; });
  };
  expect_error_at(kHeader + "(\n" + numbers(limits::kSpecFields + 9, "m", " = 1\n") + ")\n",
                  ErrorCode::Limit, 3 + limits::kSpecFields);
  expect_error_at(kHeader + "def \"A\"\n{\n    rel r = <" + repeated("/A", 2001) + ">\n}\n",
                  ErrorCode::Limit, 4);
  expect_error_at(kHeader + "def \"A\"\n{\n    rel r = </" +
                      std::string(limits::kPathTextLength + 1, 'a') + ">\n}\n",
                  ErrorCode::Limit, 4);
  expect_error_at(kHeader + "def \"A\"\n{\n    double a = " + repeated("(", 2000) + "\n}\n",
                  ErrorCode::Parse, 4);
}

TEST(HostileText, BracketsAHundredThousandLevelsDeep) {
  for (const char* open : {"[", "(", "{"}) {
    const std::string deep = repeated(open, 100'000);
    expect_bounded(kHeader + "def \"A\" {\n    double[] a = " + deep, Expected::Refused);
    expect_bounded(kHeader + "(\n    unknown = " + deep, Expected::Refused);
    expect_bounded(kHeader + "(\n    references = " + deep, Expected::Refused);
    expect_bounded(kHeader + "def \"A\" {\n    double a.timeSamples = { 1: " + deep,
                   Expected::Refused);
    expect_bounded(kHeader + deep, Expected::Refused);
  }
}

TEST(HostileText, NothingIsClosed) {
  for (const char* open : {"\"", "\"\"\"", "'", "'''", "@", "@@@", "<", "#", "/*", "/"}) {
    expect_bounded(kHeader + "(\n    doc = " + open + repeated("a\\", 500'000), Expected::Refused);
    expect_bounded(kHeader + repeated(open, 300'000), Expected::Either);
  }
}

TEST(HostileText, BytesThatAreNoText) {
  expect_bounded(kHeader + std::string(500'000, '\0'), Expected::Either);
  expect_bounded(
      kHeader + "def \"A\" { string s = \"" + repeated("\xff\xc3\x28", 200'000) + "\" }\n",
      Expected::Either);
  expect_bounded(kHeader + "def \"" + repeated("\xc3\x28", 100'000) + "\" {}\n", Expected::Refused);
  expect_bounded("\xef\xbb\xbf" + kHeader, Expected::Either);
  expect_bounded("#usda 1.0\r\n(\r\n    doc = \"a\"\r\n)\r\n" + repeated("\r\n", 300'000),
                 Expected::Accepted);
}

TEST(HostileText, TwoHundredThousandVariants) {
  const std::string variants =
      numbered(200'000, [](const std::string& number) { return "\"v" + number + "\" {}\n"; });
  expect_bounded(kHeader + "def \"A\" {\nvariantSet \"s\" = {\n" + variants + "}\n}\n",
                 Expected::Accepted);
}

TEST(HostileText, SamplesInDescendingOrder) {
  std::string samples;
  for (int i = 300'000; i > 0; --i) {
    samples += std::to_string(i) + ": 1,\n";
  }
  expect_bounded(kHeader + "def \"A\" {\n    double a.timeSamples = {\n" + samples + "}\n}\n",
                 Expected::Accepted);
}

TEST(HostileText, KnotsInDescendingOrder) {
  std::string knots;
  for (int i = 100'000; i > 0; --i) {
    knots += std::to_string(i) + ": 1; post held,\n";
  }
  expect_bounded(kHeader + "def \"A\" {\n    double a.spline = {\nbezier,\n" + knots + "}\n}\n",
                 Expected::Either);
}

struct Case {
  const char* name;
  std::string text;
  Expected expected = Expected::Accepted;
};

/// What a text of `count` pieces takes from the heap grows with the count.
void expect_linear(const char* name, const std::function<std::string(std::size_t)>& text) {
  SCOPED_TRACE(name);
  constexpr std::size_t kCount = 4000;
  std::uint64_t taken[2] = {0, 0};
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
    const std::string bytes = text(kCount << (2 * i));
    const Cost cost = measure([&] { return read_input(bytes); }, allowance_of(bytes.size()));
    EXPECT_EQ(cost.failure, "");
    EXPECT_EQ(cost.outcome, kRead);
    taken[i] = cost.taken;
  }
  EXPECT_LE(taken[1], 6 * taken[0]);  // 4, and some for lists that double; 16 were it quadratic
}

constexpr std::size_t kMany = 60'000;

std::string in_layer(const std::string& text) { return kHeader + "(\n" + text + ")\n"; }
std::string in_prim(const std::string& text) { return kHeader + "def \"A\" {\n" + text + "}\n"; }

void expect_all_bounded(const std::vector<Case>& cases) {
  for (const Case& one : cases) {
    SCOPED_TRACE(one.name);
    expect_bounded(one.text, one.expected);
  }
}

TEST(HostileText, ManyStatements) {
  using Number = const std::string&;
  expect_all_bounded({
      {"attributes", in_prim(numbered(kMany, [](Number n) { return "int a" + n + "\n"; }))},
      {"prims", in_prim(numbered(kMany, [](Number n) { return "def \"p" + n + "\" {}\n"; }))},
      {"one prim", in_prim(repeated("over \"p\" {}\n", kMany)), Expected::Refused},
      {"one attribute", in_prim(repeated("int a = 1\n", kMany))},
      {"one variant", in_prim("variantSet \"s\" = {\n" + repeated("\"v\" {}\n", kMany) + "}\n")},
      {"variant sets",
       in_prim(numbered(kMany, [](Number n) { return "variantSet \"s" + n + "\" = {}\n"; }))},
      {"metadata", in_layer(numbered(kMany, [](Number n) { return "m" + n + " = 1\n"; })),
       Expected::Refused},
      {"list edits", in_layer(numbered(kMany, [](Number n) { return "add m" + n + " = [1]\n"; })),
       Expected::Refused},
      {"keys of a dictionary",
       in_layer("customLayerData = {\n" +
                numbered(kMany, [](Number n) { return "int k" + n + " = 1\n"; }) + "}\n")},
      {"targets added one by one",
       in_prim("prepend rel r = [" +
               numbered(kMany / 8, [](Number n) { return "</A/p" + n + ">, "; }) + "]\n" +
               numbered(kMany / 16, [](Number n) { return "add rel r = </A/p" + n + ">\n"; }))},
  });
}

TEST(HostileText, WorkGrowsAsTheTextDoes) {
  using Number = const std::string&;
  const auto items = [](std::size_t count, const char* start, const char* end) {
    return numbered(count, [&](Number n) { return start + n + end; });
  };
  expect_linear("targets added one by one", [&](std::size_t count) {
    return in_prim("prepend rel r = [" + items(count, "</A/p", ">, ") + "]\n" +
                   items(count, "add rel r = </A/p", ">\n"));
  });
  expect_linear("references appended one by one", [&](std::size_t count) {
    return kHeader + "def \"A\" (\nprepend references = [" + items(count, "@r", "@, ") + "]\n" +
           items(count, "append references = @r", "@\n") + ") {\n}\n";
  });
  expect_linear("connections", [&](std::size_t count) {
    return in_prim("append int a.connect = [" + items(count, "</A.p", ">, ") + "]\n" +
                   items(count, "delete int a.connect = </A.p", ">\n"));
  });
  expect_linear("attributes",
                [&](std::size_t count) { return in_prim(items(count, "int a", " = 1\n")); });
  expect_linear("edits of an array", [&](std::size_t count) {
    return in_prim("int[] a = edit [" + items(count, "insert ", " at [0]; ") + "]\n");
  });
}

TEST(HostileText, LongLists) {
  using Number = const std::string&;
  const std::string targets = numbered(kMany, [](Number n) { return "</A/p" + n + ">, "; });
  expect_all_bounded({
      {"targets", in_prim("rel r = [" + targets + "]\n")},
      {"connections", in_prim("double a.connect = [" + targets + "]\n")},
      {"equal targets", in_prim("rel r = [" + repeated("</A.b>, ", kMany) + "]\n"),
       Expected::Refused},
      {"relocates",
       in_layer("relocates = {\n" +
                numbered(kMany, [](Number n) { return "</A/p" + n + ">: </B/q" + n + ">,\n"; }) +
                "}\n")},
      {"sublayers", in_layer("subLayers = [" +
                             numbered(kMany, [](Number n) { return "@s" + n + "@, "; }) + "]\n")},
      {"references", kHeader + "def \"A\" (\n    references = [" +
                         numbered(kMany, [](Number n) { return "@r" + n + "@, "; }) + "]\n) {}\n"},
  });
}

TEST(HostileText, LongWords) {
  const std::string name(1'000'000, 'a');
  const std::string digits(1'000'000, '7');
  expect_bounded(kHeader + "def \"" + name + "\" {}\n", Expected::Either);
  expect_bounded(kHeader + "def \"A\" {\n    int " + name + " = 1\n}\n", Expected::Either);
  for (const char* type : {"int", "uint64", "double", "half", "uchar", "bool"}) {
    expect_bounded(kHeader + "def \"A\" {\n    " + type + " a = " + digits + "\n}\n",
                   Expected::Either);
    expect_bounded(kHeader + "def \"A\" {\n    " + type + " a = 1e" + digits + "\n}\n",
                   Expected::Either);
  }
  expect_bounded(kHeader + "def \"A\" {\n    rel r = <" + repeated("/A", 400'000) + ">\n}\n",
                 Expected::Refused);
  expect_bounded(kHeader + "def \"A\" {\n    rel r = <" + repeated("/A.r[", 100'000) + ">\n}\n",
                 Expected::Refused);
  expect_bounded(kHeader + "def \"A\" {\n    rel r = <" + repeated("../", 300'000) + "B>\n}\n",
                 Expected::Either);
}

/// A small crate, taken apart: a prim with one attribute.
fuzz::CrateParts small_crate() {
  const std::string text =
      kHeader + "def \"A\" {\n    int[] a = [" + repeated("1, ", 40) + "]\n}\n";
  Diagnostics diagnostics;
  const auto layer = formats::read_layer(bytes::FileBytes::own(text), "small.usda", diagnostics);
  return *fuzz::take_apart(*formats::write_crate(*layer));
}

TEST(HostileCrate, TablesThatClaimTwoToTheSixty) {
  for (unsigned table = 0; table < 6; ++table) {
    for (const std::uint64_t count : {1ull << 32, 1ull << 60, ~0ull}) {
      SCOPED_TRACE(table);
      fuzz::CrateParts parts = small_crate();
      parts.claiming_table = table;
      parts.claimed_count = count;
      expect_bounded(put_together(parts), Expected::Refused);
    }
  }
}

/// Rows that say the same or nothing over and over, in a few kilobytes: the first one that cannot
/// be ends it.
TEST(HostileCrate, TablesOfMillionsOfRows) {
  constexpr std::size_t kRows = 8'000'000;
  fuzz::CrateParts tokens = small_crate();
  tokens.tokens += std::string(kRows, '\0');
  tokens.token_count += kRows;
  fuzz::CrateParts fields = small_crate();
  fields.field_names.resize(kRows, fields.field_names.back());
  fields.field_words.resize(kRows, fields.field_words.back());
  fuzz::CrateParts sets = small_crate();
  sets.field_sets.insert(sets.field_sets.end(), kRows, formats::crate::kEndOfSet);
  fuzz::CrateParts long_set = small_crate();
  long_set.field_sets.insert(long_set.field_sets.end() - 1, kRows, 0);
  fuzz::CrateParts specs = small_crate();
  fuzz::CrateParts paths = small_crate();
  for (fuzz::Column* column : {&specs.spec_paths, &specs.spec_sets, &specs.spec_kinds}) {
    column->insert(column->end(), kRows, column->back());
  }
  for (fuzz::Column* column : {&paths.paths, &paths.path_tokens, &paths.path_jumps}) {
    column->insert(column->end(), kRows, column->back());
  }
  paths.path_count += kRows;
  for (const fuzz::CrateParts* parts : {&tokens, &fields, &sets, &long_set, &specs, &paths}) {
    const std::string bytes = put_together(*parts);
    EXPECT_LT(bytes.size(), 400'000u);
    expect_bounded(bytes, Expected::Refused);
  }
}

/// A tree of a million prims with one name: its second path is there already.
TEST(HostileCrate, SiblingsOfOneName) {
  constexpr std::uint32_t kMax = 4'000'000;
  fuzz::CrateParts parts = small_crate();
  const std::uint32_t name = parts.path_tokens[1];
  parts.paths = {0};
  parts.path_tokens = {0};
  parts.path_jumps = {static_cast<std::uint32_t>(-1)};
  for (std::uint32_t i = 1; i < kMax; ++i) {
    parts.paths.push_back(i);
    parts.path_tokens.push_back(name);
    parts.path_jumps.push_back(i + 1 < kMax ? 0u : static_cast<std::uint32_t>(-2));
  }
  parts.path_count = kMax;
  expect_bounded(put_together(parts), Expected::Refused);
}

TEST(HostileCrate, ArraysThatUnpackToGigabytes) {
  const fuzz::Column zeros(4'000'000, 0);  // 16 MB out of 4 kB
  const std::string packed = bytes::encode_integers(std::span<const std::uint32_t>(zeros));
  fuzz::CrateParts parts = small_crate();
  for (std::size_t i = 0; i < parts.field_words.size(); ++i) {
    if (parts.field_words[i].is_packed()) {
      for (std::size_t copy = 0; copy < 40; ++copy) {
        formats::crate::ValueWord word = parts.field_words[i];
        word.bits = (word.bits & ~formats::crate::ValueWord::kPayloadMask) |
                    (sizeof(formats::crate::Bootstrap) + parts.data.size());
        bytes::ByteWriter array;
        array.write(std::uint64_t{zeros.size()});
        array.write(std::uint64_t{packed.size()});
        array.write_text(packed);
        parts.data += array.bytes();
        parts.field_words[i] = word;
        parts.field_words.push_back(word);
        parts.field_names.push_back(parts.field_names[i]);
      }
      break;
    }
  }
  // They are decoded when asked for, as far as the arrays of a file may go.
  const std::string bytes = put_together(parts);
  Allowance allowance = allowance_of(bytes.size());
  allowance.bytes += limits::kCrateArrays + 2 * 16'000'000;
  const Cost cost = measure([&] { return read_input(bytes); }, allowance);
  EXPECT_EQ(cost.excess(allowance, Cost::Judge::Hang), "");
}

TEST(HostileCrate, OneArrayThatManySamplesShareIsDecodedOnce) {
  std::string samples;
  for (int i = 0; i < 3000; ++i) {
    samples += std::to_string(i) + ": [" + repeated("7, ", 300) + "],\n";
  }
  const std::string text =
      kHeader + "def \"A\" {\n    int[] a.timeSamples = {\n" + samples + "}\n}\n";
  Diagnostics diagnostics;
  const auto layer = formats::read_layer(bytes::FileBytes::own(text), "shared.usda", diagnostics);
  ASSERT_TRUE(layer);
  const auto crate = formats::write_crate(*layer);
  ASSERT_TRUE(crate);
  expect_bounded(*crate, Expected::Accepted);
}

/// Samples of a mesh that does not move name one array of the file, which costs no memory.
TEST(HostileCrate, OneArrayOfPointsThatManySamplesShareIsRead) {
  const layer::Value points(std::vector<Vec3f>(100'000, Vec3f{1, 2, 3}));
  layer::TimeSamples samples;
  for (int i = 0; i < 1000; ++i) {
    samples.set(i, points);
  }
  layer::Layer layer("points");
  const Path prim = Path::absolute_root().child(Token("A"));
  layer.root().set("primChildren", std::vector<Token>{Token("A")});
  layer::Spec& spec = layer.create(prim, layer::SpecKind::Prim);
  spec.set("specifier", layer::Specifier::Def);
  spec.set("properties", std::vector<Token>{Token("p")});
  layer::Spec& attribute = layer.create(prim.property(Token("p")), layer::SpecKind::Attribute);
  attribute.set("typeName", Token("point3f[]"));
  attribute.set("timeSamples", samples);
  const auto crate = formats::write_crate(layer);
  ASSERT_TRUE(crate);
  ASSERT_LT(crate->size(), 2'000'000u);
  expect_bounded(*crate, Expected::Accepted);
}

/// No writer does so, but the rows of the tree may stand in another order than depth first.
TEST(OddCrate, RowsOfPathsInAnotherOrder) {
  const std::string text = kHeader +
                           "def \"A\" {\ndef \"B\" {\ndef \"X\" {\n}\n}\ndef \"C\" {\n}\n}\n"
                           "def \"D\" {\n}\n";
  Diagnostics diagnostics;
  const auto layer = formats::read_layer(bytes::FileBytes::own(text), "small.usda", diagnostics);
  ASSERT_TRUE(layer);
  fuzz::CrateParts parts = *fuzz::take_apart(*formats::write_crate(*layer));
  const auto jump = [](int rows) { return static_cast<std::uint32_t>(rows); };
  ASSERT_EQ(parts.path_jumps,
            (fuzz::Column{jump(-1), jump(4), jump(2), jump(-2), jump(-2), jump(-2)}));
  std::swap(parts.paths[4], parts.paths[5]);  // C and D
  std::swap(parts.path_tokens[4], parts.path_tokens[5]);
  parts.path_jumps = {jump(-1), jump(3), jump(3), jump(-2), jump(-2), jump(-2)};
  const auto back =
      formats::read_layer(bytes::FileBytes::own(put_together(parts)), "odd.usdc", diagnostics);
  ASSERT_TRUE(back) << back.error().to_string();
  EXPECT_TRUE(back->has(Path::from("/A/C")));
  EXPECT_TRUE(back->has(Path::from("/A/B/X")));
  EXPECT_TRUE(back->has(Path::from("/D")));
  EXPECT_EQ(back->spec_count(), layer->spec_count());
}

TEST(HostileCrate, PathsAHundredThousandElementsDeep) {
  fuzz::CrateParts parts = small_crate();
  constexpr std::uint32_t kDeep = 100'000;
  const std::uint32_t name = parts.path_tokens[1];
  parts.paths = {0};
  parts.path_tokens = {0};
  parts.path_jumps = {static_cast<std::uint32_t>(-1)};
  for (std::uint32_t i = 1; i < kDeep; ++i) {
    parts.paths.push_back(i);
    parts.path_tokens.push_back(name);
    parts.path_jumps.push_back(static_cast<std::uint32_t>(i + 1 < kDeep ? -1 : -2));
  }
  parts.path_count = kDeep;
  expect_bounded(put_together(parts), Expected::Refused);
}

TEST(HostileStage, VariablesThatDouble) {
  std::string variables = "string A0 = \"x\"\n";
  for (int i = 1; i < 90; ++i) {
    const std::string before = "${A" + std::to_string(i - 1) + "}";
    variables += "string A" + std::to_string(i) + " = '`\"" + before + before + "\"`'\n";
  }
  expect_composes(kHeader + "(\n    expressionVariables = {\n" + variables +
                  "}\n    subLayers = [@`\"${A89}\"`@]\n)\n");
}

/// A prim with arcs and children, each on lines of their own.
std::string prim(const std::string& name, const std::string& metadata, const std::string& inside) {
  return "def \"" + name + "\" (\n" + metadata + "\n)\n{\n" + inside + "}\n";
}

TEST(HostileStage, ReferencesThatDouble) {
  std::string prims = "def \"L60\"\n{\n    int x = 1\n}\n";
  for (int i = 0; i < 60; ++i) {
    const std::string next = "references = </L" + std::to_string(i + 1) + ">";
    prims += prim("L" + std::to_string(i), "", prim("a", next, "") + prim("b", next, ""));
  }
  expect_composes(kHeader + prims);
}

TEST(HostileStage, ArcsThatDouble) {
  for (const char* arc : {"references", "inherits", "specializes", "payload"}) {
    SCOPED_TRACE(arc);
    std::string prims = "def \"L20a\"\n{\n    int x = 1\n}\ndef \"L20b\"\n{\n}\n";
    for (int i = 0; i < 20; ++i) {
      const std::string next = std::to_string(i + 1);
      const std::string arcs = std::string(arc) + " = [</L" + next + "a>, </L" + next + "b>]";
      prims += prim("L" + std::to_string(i) + "a", arcs, "");
      prims += prim("L" + std::to_string(i) + "b", arcs, "");
    }
    expect_composes(kHeader + prims);
  }
}

TEST(HostileStage, ArcsThatGoInCircles) {
  for (const char* arc : {"references", "inherits", "specializes", "payload"}) {
    SCOPED_TRACE(arc);
    const std::string to = std::string(arc) + " = ";
    expect_composes(kHeader + prim("A", to + "</B>", prim("C", to + "</A>", "")) +
                    prim("B", to + "[</A>, </A/C>, </B>]", prim("C", to + "</B>", "")));
  }
}

TEST(HostileStage, ChainsOfArcs) {
  for (const char* arc : {"references", "specializes"}) {
    SCOPED_TRACE(arc);
    std::string prims;
    for (int i = 0; i < 1100; ++i) {
      prims += prim("P" + std::to_string(i),
                    std::string(arc) + " = </P" + std::to_string(i + 1) + ">", "");
    }
    expect_composes(kHeader + prims);
  }
}

TEST(HostileStage, LongListEdits) {
  const std::string items =
      numbered(20'000, [](const std::string& n) { return "\"S" + n + "\", "; });
  expect_composes(kHeader + prim("A", "prepend apiSchemas = [" + items + "]", ""));
  const std::string targets =
      numbered(20'000, [](const std::string& n) { return "</B/p" + n + ">, "; });
  expect_composes(kHeader + "def \"A\" {\n    prepend rel r = [" + targets + "]\n}\n");
}

TEST(HostileStage, LoopsOfASpline) {
  const std::string knots =
      numbered(1000, [](const std::string& n) { return n + ": " + n + "; post linear,\n"; });
  expect_composes(kHeader +
                  "def \"A\" {\n    double a.spline = {\nbezier,\nloop: (0, 1000, 2000000000, "
                  "2000000000, 1),\n" +
                  knots + "}\n}\n");
}

}  // namespace
}  // namespace tenon::robustness
