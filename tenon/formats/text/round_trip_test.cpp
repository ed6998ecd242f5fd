// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tenon/base/limits/limits.h"
#include "tenon/formats/text/reader.h"
#include "tenon/formats/text/write/writer.h"

namespace tenon::formats {
namespace {

std::vector<std::string> seed_texts() {
  std::vector<std::string> texts;
  const std::filesystem::path folder =
      std::filesystem::path(TENON_SOURCE_DIR) / "fuzz" / "corpus" / "text_fuzz";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream file(entry.path(), std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return texts;
}

/// The canonical text, or "" when the text is rejected.
std::string canonical(const std::string& text) {
  Diagnostics diagnostics;
  const auto layer = read_text(text, "t.usda", diagnostics);
  return layer ? write_text(*layer) : std::string();
}

/// Strings end at a zero byte, as OpenUSD writes them: a second writing may find them empty and
/// leave them out.
std::string settled(const std::string& text, const std::string& once) {
  const bool has_zero_byte = text.find('\0') != std::string::npos ||
                             text.find("\\0") != std::string::npos ||
                             text.find("\\x") != std::string::npos;
  return has_zero_byte ? canonical(once) : once;
}

TEST(TextRoundTrip, CanonicalTextGivesItselfAgain) {
  int accepted = 0;
  for (const std::string& text : seed_texts()) {
    const std::string once = settled(text, canonical(text));
    accepted += once.empty() ? 0 : 1;
    EXPECT_EQ(once, once.empty() ? once : canonical(once));
  }
  EXPECT_GE(accepted, 3);
}

/// A prim with children p<first> to p2499, properties before and variants after them.
std::string large_text(int first, const std::string& property) {
  std::string text = "#usda 1.0\n\ndef \"World\"\n{\n" + property;
  for (int i = first; i < 2500; ++i) {
    text += i == first && property.empty() ? "" : "\n";
    text += "    def \"p" + std::to_string(i) + "\"\n    {\n    }\n";
  }
  return text + "    variantSet \"v\" = {\n        \"a\" {\n\n        }\n    }\n}\n\n" +
         "def \"Other\"\n{\n}\n\n";
}

TEST(TextRoundTrip, LargeLayersAreWrittenInHalves) {
  for (const std::string property : {"", "    int before = 1\n"}) {
    Diagnostics diagnostics;
    auto layer = read_text(large_text(0, property), "t.usda", diagnostics);
    ASSERT_TRUE(layer);
    EXPECT_EQ(write_text(*layer), large_text(0, property));
    // Listed, but not there: all of the first half.
    for (int i = 0; i < 1250; ++i) {
      layer->erase(Path::from("/World/p" + std::to_string(i)));
    }
    EXPECT_EQ(write_text(*layer), large_text(1250, property));
  }
}

std::string repeated(const char* text, std::size_t count) {
  std::string all;
  for (std::size_t i = 0; i < count; ++i) {
    all += text;
  }
  return all;
}

TEST(TextRoundTrip, TheDeepestAllowedNestingIsReadAndWritten) {
  const std::size_t depth = limits::kTextNestingDepth - 1;
  const std::string header = "#usda 1.0\n";
  const std::string texts[] = {
      header + repeated("def \"A\" {\n", depth) + repeated("}\n", depth),
      header + "(\n customLayerData = {" + repeated("dictionary a = {", depth) +
          repeated("}\n", depth) + "}\n)\n",
      header + "(\n a = " + repeated("[", depth) + "1" + repeated("]", depth) + "\n)\n",
      header + "def \"P\" {\n int[] a = " + repeated("[", depth) + "1" + repeated("]", depth) +
          "\n}\n",
  };
  for (const std::string& text : texts) {
    const std::string once = canonical(text);
    EXPECT_FALSE(once.empty());
    EXPECT_EQ(once, canonical(once));
  }
}

/// One to four bytes changed, removed or doubled, or the end cut off.
std::string mutated(const std::string& seed, std::mt19937& random) {
  constexpr std::string_view kMarks = "{}()[]<>@\"'=:;,.#/\\\n 0-enN\x80\xff";
  std::string text = seed;
  const auto below = [&](std::size_t limit) {
    return static_cast<std::size_t>(random()) % std::max<std::size_t>(limit, 1);
  };
  const std::size_t changes = 1 + below(4);
  for (std::size_t i = 0; i < changes && !text.empty(); ++i) {
    const std::size_t at = below(text.size());
    switch (below(5)) {
      case 0:
        text.erase(at, 1 + below(8));
        break;
      case 1:
        text.insert(at, 1, kMarks[below(kMarks.size())]);
        break;
      case 2:
        text.insert(at, text.substr(at, below(40)));
        break;
      case 3:
        text[at] = kMarks[below(kMarks.size())];
        break;
      default:
        text.resize(below(8) == 0 ? at : text.size());
        break;
    }
  }
  return text;
}

TEST(TextRoundTrip, MutatedTextsAreReadOrRejectedWithAPlace) {
  std::mt19937 random(20261121);
  int accepted = 0;
  int rejected = 0;
  for (const std::string& seed : seed_texts()) {
    for (int i = 0; i < 400; ++i) {
      const std::string text = mutated(seed, random);
      Diagnostics diagnostics;
      const auto layer = read_text(text, "t.usda", diagnostics);
      if (layer) {
        ++accepted;
        const std::string once = settled(text, write_text(*layer));
        EXPECT_EQ(once, canonical(once)) << text;
      } else {
        ++rejected;
        EXPECT_GT(layer.error().diagnostic().line, 0u) << text;
        EXPECT_FALSE(layer.error().message().empty());
      }
    }
  }
  EXPECT_GT(accepted, 100);
  EXPECT_GT(rejected, 1000);
}

}  // namespace
}  // namespace tenon::formats
