// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Reading in halves gives what reading from front to end gives, for any text: reading with sources
// never splits.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "tenon/formats/text/layer_reader.h"
#include "tenon/formats/text/layout/source_map.h"
#include "tenon/formats/text/reader.h"
#include "tenon/formats/text/split_text.h"
#include "tenon/formats/text/write/writer.h"

namespace tenon::formats {
namespace {

/// Everything that can be seen of a result: findings, the error, or the specs in their order.
std::string account_of(const Result<layer::Layer>& layer, const Diagnostics& diagnostics) {
  std::string account;
  for (const Diagnostic& diagnostic : diagnostics) {
    account += diagnostic.to_string() + "\n";
  }
  if (!layer) {
    return account + layer.error().to_string();
  }
  for (const layer::Layer::Entry& entry : layer->entries()) {
    account += entry.path.str() + " " + std::to_string(static_cast<int>(entry.spec.kind)) + " " +
               std::to_string(entry.spec.line) + ":" + std::to_string(entry.spec.column);
    for (const layer::Field& field : entry.spec.fields()) {
      account += " " + field.name.str();
    }
    account += "\n";
  }
  return account + write_text(*layer);
}

std::string in_halves(const std::string& text) {
  Diagnostics diagnostics;
  const auto layer = read_text_in_halves(text, "t.usda", diagnostics);
  return account_of(layer, diagnostics);
}

/// The second half could be taken over and need not be read once more.
bool is_joined(const std::string& text) {
  const std::size_t split = text::find_split(text);
  Diagnostics diagnostics;
  Diagnostics more;
  text::LayerReader first(text, "t.usda", diagnostics, nullptr);
  text::LayerReader second(text, "t.usda", more, nullptr);
  first.read_from_front(split);
  second.read_from(split, true);
  return first.stopped() && first.take_rest(second);
}

std::string as_one(const std::string& text) {
  Diagnostics diagnostics;
  text::SourceMap sources;
  const auto layer = read_text_with_sources(text, "t.usda", diagnostics, sources);
  return account_of(layer, diagnostics);
}

std::string prims(const std::string& indentation, const std::string& name, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += indentation + "def Cube \"" + name + std::to_string(i) + "\"\n" + indentation + "{\n" +
            indentation + "    double size = " + std::to_string(i % 3) + "\n" + indentation + "}\n";
  }
  return text;
}

TEST(TextHalves, AreSplitAtAPrimOfTheSecondHalf) {
  const std::string text = "#usda 1.0\ndef \"A\"\n{\n    over \"B\"\n    {\n" +
                           prims("        ", "c", 10) + "    }\n" + prims("    ", "d", 9) + "}\n";
  const std::size_t split = text::find_split(text);
  ASSERT_NE(split, std::string::npos);
  EXPECT_GE(split, text.size() / 2);
  EXPECT_EQ(text.substr(split, 12), "def Cube \"c9");
  const auto around = text::prims_around(text, split);
  ASSERT_EQ(around.size(), 2u);
  EXPECT_EQ(text.substr(around[0], 7), "def \"A\"");
  EXPECT_EQ(text.substr(around[1], 8), "over \"B\"");
  EXPECT_EQ(text::find_split("#usda 1.0\n" + std::string(100, '\n')), std::string::npos);
  EXPECT_EQ(text::find_split(""), std::string::npos);
}

TEST(TextHalves, GiveWhatTheWholeGives) {
  const std::string many = prims("    ", "a", 20);
  const std::string head = "#usda 1.0\n";
  struct Row {
    std::string text;
    bool joined;
  };
  const Row rows[] = {
      {head + prims("", "a", 20), true},
      {head + "def \"A\"\n{\n" + many + prims("    ", "b", 20) + "}\n", true},
      // properties, orders and relationships of prims that are open at the split
      {head + "def \"A\"\n{\n    int x = 1\n" + many + "    int y = 2\n    rel r = </A>\n}\n",
       true},
      {head + "def \"A\"\n{\n    int x = 1\n" + many + "    int x.timeSamples = {1: 2}\n}\n",
       false},
      {head + "def \"A\"\n{\n" + many + "    reorder nameChildren = [\"a3\", \"a1\"]\n}\n", false},
      {head + prims("", "a", 20) + "reorder rootPrims = [\"a3\", \"a1\"]\n", false},
      // the same prim once more
      {head + "def \"A\"\n{\n" + many + "    def \"a2\"\n    {\n    }\n}\n", false},
      {head + prims("", "a", 20) + "def \"a2\"\n{\n}\n", false},
      // variants before, around and after
      {head + "def \"A\"\n{\n    variantSet \"v\" = {\n        \"x\" {\n" + many + "        }\n" +
           "    }\n" + prims("    ", "b", 3) + "}\n",
       false},
      {head + "def \"A\"\n{\n" + many + "    variantSet \"v\" = {\n        \"x\" {\n" +
           prims("            ", "b", 3) + "        }\n    }\n}\n",
       false},
      {head + "def \"A\"\n{\n    variantSet \"v\" = {\n        \"x\" {\n        }\n    }\n" + many +
           "    variantSet \"w\" = {\n        \"x\" {\n        }\n    }\n}\n",
       false},
      {head + "def \"A\"\n{\n    variantSet \"v\" = {\n        \"x\" {\n        }\n    }\n" + many +
           "}\n",
       true},
      // what looks like prims and is none
      {head + "def \"A\" (\n    doc = \"\"\"\n" + many + prims("    ", "a", 9) +
           "\"\"\"\n)\n{\n}\n",
       false},
      {head + "/*\n" + prims("", "a", 20) + "*/\n" + prims("", "b", 2), false},
      // indentation that misleads
      {head + "def \"A\"\n{\n" + prims("", "a", 20) + "}\n", false},
      {head + "def \"A\"\n{\n}\n" + many, false},
      // findings and errors in either half
      {head + "def \"A\" (\n    apiSchemas = [\"X\", \"X\"]\n)\n{\n}\n" + prims("", "a", 20), true},
      {head + prims("", "a", 20) + "def \"A\" (\n    apiSchemas = [\"X\", \"X\"]\n)\n{\n}\n",
       false},
      {head + prims("", "a", 20) + "def \"A\"\n{\n    int x = [\n}\n", false},
      {head + "def \"A\"\n{\n    int x = [\n}\n" + prims("", "a", 20), false},
      {head + "def \"A\"\n{\n" + many, false},
      {head + prims("", "a", 20) + "}\n", false},
      {head + prims("", "a", 20) + "\xff\n", false},
      {prims("", "a", 20), false},
  };
  for (const auto& [text, joined] : rows) {
    ASSERT_NE(text::find_split(text), std::string::npos) << text;
    EXPECT_EQ(in_halves(text), as_one(text)) << text;
    EXPECT_EQ(is_joined(text), joined) << text;
  }
}

/// Text layers below `folder`, in any order.
std::size_t compare_below(const std::filesystem::path& folder) {
  std::size_t count = 0;
  for (const auto& found : std::filesystem::recursive_directory_iterator(folder)) {
    if (found.path().extension() != ".usda" || !found.is_regular_file() ||
        found.file_size() > std::size_t{1} << 20) {
      continue;
    }
    std::ifstream file(found.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    count += text::find_split(text) != std::string::npos ? 1u : 0u;
    EXPECT_EQ(in_halves(text), as_one(text)) << found.path();
  }
  return count;
}

TEST(TextHalves, GiveWhatTheWholeGivesForLayersOfThisProject) {
  EXPECT_GT(compare_below(TENON_SOURCE_DIR "/tests") + compare_below(TENON_SOURCE_DIR "/examples"),
            100u);
}

TEST(TextHalves, GiveWhatTheWholeGivesForPublishedLayersWhereTheyAre) {
  const char* set = ::getenv("TENON_SHARED_DIR");
  const std::string folder =
      (set == nullptr ? TENON_SOURCE_DIR "/../shared" : std::string(set)) + "/conformance";
  if (std::filesystem::exists(folder)) {
    EXPECT_GT(compare_below(folder), 500u);
  }
}

}  // namespace
}  // namespace tenon::formats
