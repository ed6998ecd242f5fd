// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/expressions/path_expression.h"

#include <gtest/gtest.h>

namespace tenon::layer {
namespace {

std::string canonical_text(std::string_view text) {
  const Result<PathExpressionTree> tree = PathExpressionTree::parse(text);
  return tree ? tree->text() : "error";
}

PathExpressionTree tree_of(std::string_view text) {
  return PathExpressionTree::parse(text).value();
}

TEST(PathExpression, TextIsCanonical) {
  const std::pair<const char*, const char*> cases[] = {
      {" /a  /b ", "/a /b"},
      {"~ /a", "~/a"},
      {"~(~/a)", "/a"},
      {"a-b", "a - b"},
      {"(/a /b) - (/c /d)", "/a /b - /c /d"},
      {"/a - (/b - /c)", "/a - (/b - /c)"},
      {"(/a & /b) + /c", "(/a & /b) + /c"},
      {"../../x//", "../../x//"},
      {".//", ".//"},
      {"/a//b.c", "/a//b.c"},
      {"/a*[!0-9]?x", "/a*[!0-9]?x"},
      {"/a.{x}", "/a.{x}"},
      {"%../x:y %:b %_", "%../x:y %:b %_"},
      {"/a\n/b", "/a"},
      {"~//", ""},
      {"// - /a", "~/a"},
      {"/a & //", "/a"},
      {"", ""},
  };
  for (const auto& [text, expected] : cases) {
    EXPECT_EQ(canonical_text(text), expected) << text;
  }
}

TEST(PathExpression, PredicateTextIsCanonical) {
  const std::pair<const char*, const char*> cases[] = {
      {"//{isa:Mesh and not (model or group)}", "//{isa:\"Mesh\" and not (model or group)}"},
      {"//{kind(component, strict=true)}", "//{kind(\"component\", strict=1)}"},
      {"/a{x:1,2.5,-inf,1e5,'b c'}", "/a{x:1,2.5,-inf,100000,\"b c\"}"},
      {"{x()} {x:} {x( 1 , y = 2 )}", "{x(\"\")} {x:\"\"} {x(1, y=2)}"},
      {"{not(x)} {not not x}", "{not x} {not not x}"},
      {"{x:9999999999999999999}", "{x:\"9999999999999999999\"}"},
      {"{(a b or c) and d}", "{(a b or c) and d}"},
  };
  for (const auto& [text, expected] : cases) {
    EXPECT_EQ(canonical_text(text), expected) << text;
  }
}

TEST(PathExpression, RefusesWhatIsNone) {
  for (const char* text :
       {"~~/a",   "%_foo",  "./x",  "//.c",       "/a/b/", "/a//.x",  "/a.x//", "///",  "%x:y",
        "(/a",    "/a)",    "  ",   "{x(y=2,1)}", "{inf}", "{x",      "/a[0-9", "/a +", "{x:1.}",
        "{x:1e}", "{x:'a}", "%/:y", "/a{}",       "()",    "{a and}", "{not}"}) {
    EXPECT_EQ(canonical_text(text), "error") << text;
  }
}

TEST(PathExpression, DeepNestingNeedsNoStack) {
  const std::size_t depth = 200'000;
  EXPECT_EQ(canonical_text(std::string(depth, '(') + "/a" + std::string(depth, ')')), "/a");
  EXPECT_EQ(canonical_text("{" + std::string(depth, '(') + "a" + std::string(depth, ')') + "}"),
            "{a}");
  EXPECT_EQ(canonical_text(std::string(depth, '(')), "error");
}

TEST(PathExpression, WeakerReferencesCompose) {
  const auto composed = [](const char* strong, const char* weak) {
    return tree_of(strong).composed_over(tree_of(weak))->text();
  };
  EXPECT_EQ(composed("%_ + /s", "/w /x"), "/w /x + /s");
  EXPECT_EQ(composed("/s - %_", "/w - /x"), "/s - (/w - /x)");
  EXPECT_EQ(composed("/s - %_", ""), "/s");
  EXPECT_EQ(composed("", "/w"), "/w");
  EXPECT_EQ(composed("%:a %_", "//"), "//");
}

TEST(PathExpression, CompositionThatDoublesEnds) {
  PathExpressionTree tree = tree_of("%_ %_");
  int rounds = 0;
  while (const auto composed = tree_of("%_ %_").composed_over(tree)) {
    tree = *composed;
    ASSERT_LT(++rounds, 30);
  }
}

TEST(PathExpression, PathsAreMadeAbsoluteAndMapped) {
  PathExpressionTree tree = tree_of("a ../b// // - .//c & %../x:y ../../out");
  tree.make_absolute(Path::from("/A"));
  EXPECT_EQ(tree.text(), "~(/A//c & %/x:y ../../out)");
  tree = tree_of("a {x} %../x:y + ../b//");
  tree.make_absolute(Path::from("/A"));
  EXPECT_EQ(tree.text(), "/A/a /A/{x} %/x:y + /b//");
  EXPECT_EQ(tree_of("%/A:_ %:_").text(), "%/A:_ %_");
  PathExpressionTree in_variant = tree_of("b %../x:y");
  in_variant.make_absolute(Path::from("/A{v=one}c"));
  EXPECT_EQ(in_variant.text(), "/A/c/b %/A/x:y");
  const auto map = [](Path path) {
    return path.has_prefix(Path::from("/A"))
               ? path.replace_prefix(Path::from("/A"), Path::from("/R"))
               : Path();
  };
  EXPECT_EQ(tree.mapped(map).text(), "/R/a /R/{x}");
}

TEST(PathExpression, PathsOfAValueAreMapped) {
  const auto map = [](Path path) {
    return path.has_prefix(Path::from("/A/gone"))
               ? Path()
               : path.replace_prefix(Path::from("/A"), Path::from("/R"));
  };
  Value one(PathExpression{"b //c + /A/gone//"});
  EXPECT_TRUE(map_paths(one, Path::from("/A"), map));
  EXPECT_EQ(one.get<PathExpression>()->text, "/R/b //c");
  Value stays(PathExpression{"( /B )"});
  EXPECT_FALSE(map_paths(stays, Path::from("/A"), map));
  EXPECT_EQ(stays.get<PathExpression>()->text, "( /B )");
  Value several(Array<PathExpression>{{"/A"}, {"/ +"}});
  EXPECT_TRUE(map_paths(several, Path::from("/A"), map));
  EXPECT_EQ((*several.get<Array<PathExpression>>())[0].text, "/R");
  EXPECT_EQ((*several.get<Array<PathExpression>>())[1].text, "/ +");
}

}  // namespace
}  // namespace tenon::layer
