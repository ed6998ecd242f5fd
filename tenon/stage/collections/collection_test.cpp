// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/collections/collection.h"

#include <gtest/gtest.h>

#include "tenon/stage/test_stage.h"

namespace tenon::stage {
namespace {

constexpr const char* kScene = R"(
def Xform "W" (
    kind = "group"
    apiSchemas = ["CollectionAPI:c", "CollectionAPI:d"]
) {
    %s
    double size = 1
    def Mesh "a1" (
        kind = "component"
    ) {
        double size = 1
    }
    def Scope "b" {
        def Mesh "a2" {
        }
    }
    class "k" {
    }
}
)";

std::string text_of(const std::string& lines) {
  std::string text = kScene;
  return text.replace(text.find("%s"), 2, lines);
}

std::string members(const std::string& lines) {
  const Stage stage = open_text(text_of(lines));
  std::string result;
  for (const Path path :
       Collection::read(stage.prim(Path::from("/W")), Token("c")).members(stage)) {
    result += (result.empty() ? "" : " ") + path.str();
  }
  return result;
}

std::string matched(const std::string& expression) {
  return members("uniform pathExpression collection:c:membershipExpression = '" + expression + "'");
}

TEST(Collection, ExpressionsMatchPathsOfTheStage) {
  EXPECT_EQ(matched("a1"), "/W/a1");
  EXPECT_EQ(matched("//a?"), "/W/a1 /W/b/a2");
  EXPECT_EQ(matched("/W/b//"), "/W/b /W/b/a2");
  EXPECT_EQ(matched("/*/[ab]*"), "/W/a1 /W/b");
  EXPECT_EQ(matched("~//a* - /W"), "/W/b");
  EXPECT_EQ(matched("(/W/a1 + b) & /W/a*"), "/W/a1");
  EXPECT_EQ(matched("/None //c"), "");
}

TEST(Collection, PredicatesAskThePrim) {
  EXPECT_EQ(matched("//{isa:Mesh}"), "/W/a1 /W/b/a2");
  EXPECT_EQ(matched("//{isa(Xformable, strict=true) or kind:model}"), "/W /W/a1");
  EXPECT_EQ(matched("//{kind(model, strict=true)}"), "");
  EXPECT_EQ(matched("//{hasAPI(CollectionAPI, instanceName=d)}"), "/W");
  EXPECT_EQ(matched("//{specifier:def and not isa:Gprim}"), "/W /W/b");
  EXPECT_EQ(matched("/W/b{isa:Mesh}//"), "");
  EXPECT_EQ(matched("//{nothing}"), "");
  EXPECT_EQ(matched("//{abstract:word}"), "");
}

TEST(Collection, ExpressionsReferToCollections) {
  const std::string d = "uniform pathExpression collection:d:membershipExpression = ";
  const std::string c = "uniform pathExpression collection:c:membershipExpression = ";
  EXPECT_EQ(members(c + "'%:d - b'\n" + d + "'a1 b'"), "/W/a1");
  EXPECT_EQ(members(c + "'%/W:d b'\n" + d + "'%:c a1'"), "/W/a1 /W/b");
  EXPECT_EQ(members(c + "'%:c %_ %/None:x'"), "");
}

TEST(PathExpressionValue, IsMappedAndComposedOverWeakerOnes) {
  const Stage stage = open_text(R"(
def "Source" {
    pathExpression e = "a %/Source:b /Other //c"
    def "in" {
        pathExpression e = "x ../y"
    }
}
def "R" (
    references = </Source>
) {
    pathExpression e = "d - %_"
    over "in" {
        pathExpression e.timeSamples = { 0: "%_ + /R/s", 5: "/R/t" }
    }
}
def "I" (
    instanceable = true
    references = </Source>
) {
    pathExpression alone = "%_ + a"
}
)");
  const auto text = [&](const char* path, Time time = {}) {
    const Path property = Path::from(path);
    const layer::Value value = stage.prim(property.parent()).attribute(property.name()).get(time);
    return value.get_or(layer::PathExpression{"none"}).text;
  };
  EXPECT_EQ(text("/R.e"), "/R/d - /R/a %/R:b /Other //c");
  EXPECT_EQ(text("/R/in.e"), "/R/in/x /R/y");
  EXPECT_EQ(text("/R/in.e", Time(1)), "/R/in/x /R/y + /R/s");
  EXPECT_EQ(text("/R/in.e", Time(6)), "/R/t");
  EXPECT_EQ(text("/I/in.e"), "/I/in/x /I/y");
  EXPECT_EQ(text("/I.alone"), "/I/a");
}

TEST(Collection, RulesFollowIncludedCollections) {
  const std::string rule = "uniform token collection:c:expansionRule = ";
  EXPECT_EQ(members("rel collection:c:includes = </W>\nrel collection:c:excludes = </W/b>"),
            "/W /W/a1");
  EXPECT_EQ(members(rule + "'explicitOnly'\nrel collection:c:includes = [</W>, </W/b/a2>]"),
            "/W /W/b/a2");
  EXPECT_EQ(members("rel collection:c:includes = </W.collection:d>\n"
                    "rel collection:d:includes = [</W/b>, </W.collection:c>, </W.size>]\n"
                    "rel collection:d:excludes = </W/b/a2>"),
            "/W/b /W.size");
  EXPECT_EQ(members("uniform bool collection:c:includeRoot = 1\n"
                    "rel collection:c:excludes = </W/a1>"),
            "/W /W/b /W/b/a2");
}

TEST(Collection, PropertiesBelongToWhatExpandsToThem) {
  const Stage stage = open_text(
      text_of("uniform token collection:c:expansionRule = 'expandPrimsAndProperties'\n"
              "rel collection:c:includes = </W>\nrel collection:c:excludes = </W/a1.size>"));
  const Collection collection = Collection::read(stage.prim(Path::from("/W")), Token("c"));
  EXPECT_TRUE(collection.contains(Path::from("/W.size")));
  EXPECT_FALSE(collection.contains(Path::from("/W/a1.size")));
  EXPECT_TRUE(collection.contains(Path::from("/W/a1")));
}

TEST(Collection, ReadingEndsAfterTheWorkThatIsAllowed) {
  std::string lines;
  for (int i = 0; i < 50; ++i) {
    const std::string name = "collection:" + (i == 0 ? "c" : "c" + std::to_string(i));
    lines +=
        "rel " + name + ":includes = [</W/a1>, </W.collection:c" + std::to_string(i + 1) + ">]\n";
  }
  const Stage stage = open_text(text_of(lines));
  const Prim prim = stage.prim(Path::from("/W"));
  const Collection whole = Collection::read(prim, Token("c"));
  EXPECT_FALSE(whole.is_cut());
  EXPECT_GE(whole.work(), std::size_t{50 * 22});
  const Collection part = Collection::read(prim, Token("c"), 200);
  EXPECT_TRUE(part.is_cut());
  EXPECT_LT(part.work(), std::size_t{260});
  EXPECT_TRUE(part.contains(Path::from("/W/a1")));
}

}  // namespace
}  // namespace tenon::stage
