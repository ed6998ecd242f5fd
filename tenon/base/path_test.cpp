// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/path.h"

#include <algorithm>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tenon/base/limits/limits.h"
#include "tenon/base/parallel.h"

namespace tenon {
namespace {

struct KindRow {
  const char* text;
  PathKind kind;
};

TEST(Path, AllKindsReadAndPrint) {
  const KindRow rows[] = {
      {"/", PathKind::AbsoluteRoot},
      {".", PathKind::RelativeRoot},
      {"/A", PathKind::Prim},
      {"/A/B_1", PathKind::Prim},
      {"A/B", PathKind::Prim},
      {"..", PathKind::Prim},
      {"../..", PathKind::Prim},
      {"../A", PathKind::Prim},
      {"/A{v=x}", PathKind::VariantSelection},
      {"/A{v=}", PathKind::VariantSelection},
      {"/A{v=x}{w=y}", PathKind::VariantSelection},
      {"/A{v=x}B", PathKind::Prim},
      {"/A{v=x}B/C{w=1-a|}D", PathKind::Prim},
      {"/A.b", PathKind::Property},
      {".b", PathKind::Property},
      {"../A.b:c:d", PathKind::Property},
      {"../.b", PathKind::Property},
      {"/A{v=x}.b", PathKind::Property},
      {"/A.r[/B]", PathKind::Target},
      {"/A.r[/B.c]", PathKind::Target},
      {"/A.r[/B].d", PathKind::RelationalAttribute},
      {"/A.r[/B.s[/C]].d", PathKind::RelationalAttribute},
      {"/A.b.mapper[/B.c]", PathKind::Mapper},
      {"/A.b.mapper[/B.c].d", PathKind::MapperArg},
      {"/A.b.expression", PathKind::Expression},
      {"/\xC3\xA9t\xC3\xA9", PathKind::Prim},
  };
  for (const KindRow& row : rows) {
    const auto path = Path::parse(row.text);
    ASSERT_TRUE(path) << row.text << ": " << path.error().to_string();
    EXPECT_EQ(path->kind(), row.kind) << row.text;
    EXPECT_EQ(path->str(), row.text);
    EXPECT_EQ(Path::from(path->str()), *path);
  }
}

TEST(Path, IllFormedTextIsRejected) {
  for (const char* text : {"",        "//",     "/A/", "/A//B", "/1A",      "/A-B",   "A B",
                           "/A.",     "/A.b.c", "/.a", "/A{v}", "/A{=x}",   "/A{v=x", "/A.r[",
                           "/A.r[/B", "/A.r[]", "/A]", "../",   "/A{v=x}/", "/\xff"}) {
    EXPECT_FALSE(Path::parse(text)) << text;
    EXPECT_TRUE(Path::from(text).empty()) << text;
  }
  const std::string deep(4 * limits::kPathElements, '/');
  std::string names;
  for (std::size_t i = 0; i <= limits::kPathElements; ++i) {
    names += "/a";
  }
  EXPECT_FALSE(Path::parse(deep));
  EXPECT_FALSE(Path::parse(names));
}

TEST(Path, ElementsAreReached) {
  const Path path = Path::from("/A/B{v=x}C.rel[/T].attr");
  EXPECT_EQ(path.name(), "attr");
  EXPECT_EQ(path.parent().target(), Path::from("/T"));
  EXPECT_EQ(path.prim(), Path::from("/A/B{v=x}C"));
  EXPECT_EQ(path.prim().parent(), Path::from("/A/B{v=x}"));
  EXPECT_EQ(path.prim().parent().variant(), "x");
  EXPECT_EQ(path.strip_variants(), Path::from("/A/B/C.rel[/T].attr"));
  EXPECT_TRUE(path.has_variants());
  EXPECT_EQ(Path::from("/A").parent(), Path::absolute_root());
  EXPECT_TRUE(Path::absolute_root().parent().empty());
  EXPECT_EQ(Path::from("/A{v=x}.b").prim_or_variant(), Path::from("/A{v=x}"));
  EXPECT_EQ(Path::from("/A{v=x}.b").prim(), Path::from("/A"));
}

TEST(Path, PrefixesAreReplaced) {
  const Path path = Path::from("/A/B.rel[/A/C].x");
  EXPECT_TRUE(path.has_prefix(Path::from("/A/B")));
  EXPECT_FALSE(path.has_prefix(Path::from("/A/B2")));
  EXPECT_TRUE(path.has_prefix(Path::absolute_root()));
  EXPECT_EQ(path.replace_prefix(Path::from("/A"), Path::from("/X/Y")),
            Path::from("/X/Y/B.rel[/X/Y/C].x"));
  EXPECT_EQ(path.replace_prefix(Path::from("/A"), Path::from("/X"), false),
            Path::from("/X/B.rel[/A/C].x"));
  EXPECT_EQ(path.replace_prefix(Path::from("/Q"), Path::from("/X")), path);
}

TEST(Path, RelativePathsAreResolvedAndMade) {
  struct Row {
    const char* relative;
    const char* anchor;
    const char* absolute;
  };
  const Row rows[] = {
      {"B", "/A", "/A/B"},       {"../B", "/A/C", "/A/B"},      {".b", "/A", "/A.b"},
      {"../.b", "/A/C", "/A.b"}, {"../../B.c", "/A/C", "/B.c"}, {".", "/A", "/A"},
  };
  for (const Row& row : rows) {
    const Path anchor = Path::from(row.anchor);
    EXPECT_EQ(Path::from(row.relative).absolute(anchor), Path::from(row.absolute)) << row.relative;
    EXPECT_EQ(Path::from(row.absolute).relative(anchor), Path::from(row.relative))
        << row.absolute << " from " << row.anchor;
  }
  EXPECT_TRUE(Path::from("../../..").absolute(Path::from("/A")).empty());
  const Path in_variant = Path::from("/A{v=x}C");
  EXPECT_EQ(Path::from("../B").absolute(in_variant), Path::from("/A{v=x}B"));
  EXPECT_EQ(Path::from("../../B").absolute(in_variant), Path::from("/A/B"));
}

TEST(Path, OrderPutsAPathBeforeWhatIsBelowIt) {
  std::vector<Path> sorted;
  for (const char* text : {"/", "/A", "/A/B", "/A/B/C", "/A2", "/B"}) {
    sorted.push_back(Path::from(text));
  }
  std::vector<Path> shuffled = sorted;
  std::mt19937 random(7);
  for (int i = 0; i < 20; ++i) {
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    std::sort(shuffled.begin(), shuffled.end());
    EXPECT_EQ(shuffled, sorted);
  }
}

// The order in which paths are asked for is what their table goes by.
TEST(Path, IsTheSameInWhateverOrderItIsAskedFor) {
  constexpr int kNames = 2000;  // more than a chunk of the table holds
  const Path parents[] = {Path::from("/Order/A"), Path::from("/Order/B")};
  std::vector<Path> made;
  for (int i = 0; i < kNames; ++i) {
    const Token name("name_" + std::to_string(i));
    made.push_back(parents[i % 2].property(name));
    made.push_back(parents[i % 2].child(name));
  }
  EXPECT_EQ(std::set<std::string>({made[0].str(), made[1].str(), made[2].str()}),
            std::set<std::string>({"/Order/A.name_0", "/Order/A/name_0", "/Order/B.name_1"}));
  std::vector<Path> shuffled = made;
  std::mt19937 random(11);
  std::shuffle(shuffled.begin(), shuffled.end(), random);
  for (const auto& order : {made, shuffled}) {
    for (const Path path : order) {
      const Path parent = path.parent();
      EXPECT_EQ(path.is_prim() ? parent.child(path.name()) : parent.property(path.name()), path);
      EXPECT_EQ(Path::from(path.str()), path);
    }
  }
}

TEST(Path, ThreadsThatMakeTheSamePathsGetTheSame) {
  constexpr int kNames = 3000;
  std::vector<Path> found[2];
  const auto make = [](std::vector<Path>& paths) {
    for (int i = 0; i < kNames; ++i) {
      paths.push_back(Path::from("/Threads").property(Token("n" + std::to_string(i))));
    }
  };
  run_both([&] { make(found[0]); }, [&] { make(found[1]); });
  EXPECT_EQ(found[0], found[1]);
}

/// No text has such paths, but code can ask for them.
TEST(Path, APropertyBelowAPropertyIsOne) {
  const Path owner = Path::from("/A.b");
  const Path path = owner.property("c");
  EXPECT_EQ(path.kind(), PathKind::Property);
  EXPECT_TRUE(path.is_property());
  EXPECT_FALSE(path.is_direct_property());
  EXPECT_EQ(path.parent(), owner);
  EXPECT_EQ(path.name(), "c");
  EXPECT_EQ(path.depth(), 3U);
  EXPECT_NE(path, Path::from("/A.c"));
  EXPECT_EQ(path.replace_prefix(owner, Path::from("/B")), Path::from("/B.c"));
  EXPECT_EQ(Path::from("/B.c").replace_prefix(Path::from("/B"), owner), path);
  EXPECT_TRUE(path.has_prefix(owner));
}

TEST(Path, TheEmptyPathHasNothing) {
  const Path none;
  EXPECT_EQ(none.kind(), PathKind::Empty);
  EXPECT_TRUE(none.empty() && none.parent().empty() && none.target().empty());
  EXPECT_TRUE(none.name().empty() && none.variant().empty());
  EXPECT_FALSE(none.is_absolute() || none.is_property() || none.has_variants());
  EXPECT_EQ(none.depth(), 0U);
  EXPECT_TRUE(none.prefixes().empty());
  EXPECT_FALSE(none.has_prefix(none));
  EXPECT_LT(none, Path::absolute_root());
}

TEST(Path, NamesAreChecked) {
  EXPECT_TRUE(is_identifier("_a1"));
  EXPECT_FALSE(is_identifier("1a"));
  EXPECT_FALSE(is_identifier("a:b"));
  EXPECT_FALSE(is_identifier(""));
  EXPECT_TRUE(is_namespaced_identifier("a:b:c"));
  EXPECT_FALSE(is_namespaced_identifier("a:"));
  EXPECT_FALSE(is_namespaced_identifier("a::b"));
  EXPECT_TRUE(is_variant_name("1-a|b"));
  EXPECT_TRUE(is_variant_name(".x"));
  EXPECT_FALSE(is_variant_name("a b"));
}

}  // namespace
}  // namespace tenon
