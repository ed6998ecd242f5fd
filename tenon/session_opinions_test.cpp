// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/session_opinions.h"

#include <memory>

#include <gtest/gtest.h>

#include "tenon/formats/text/reader.h"

namespace tenon {
namespace {

layer::LayerPtr read(const std::string& text) {
  Diagnostics diagnostics;
  auto layer = formats::read_text("#usda 1.0\n" + text, "test", diagnostics);
  EXPECT_TRUE(layer);
  return std::make_shared<const layer::Layer>(layer ? *std::move(layer) : layer::Layer("test"));
}

stage::Stage open(const layer::LayerPtr& root, const layer::LayerPtr& session) {
  auto opener = [](const std::string& path, const layer::Layer&) -> Result<layer::LayerPtr> {
    return Error(ErrorCode::NotFound, path);
  };
  auto stage = stage::Stage::open(root, session, opener);
  EXPECT_TRUE(stage);
  return *std::move(stage);
}

constexpr const char* kScene = R"((
    defaultPrim = "W"
)
def Xform "W" (
    prepend variantSets = "Physics"
    variants = {
        string Physics = "a"
    }
)
{
    token mode = "x"
    uniform double3 v = (0, 0, 0)
    asset file
    float moving.timeSamples = { 0: 1, 1: 2 }
    rel to = </W>
    variantSet "Physics" = {
        "a" {
            int n = 1
        }
        "b" {
            int n = 2
        }
    }
}
)";

TEST(SessionOpinions, AVariantIsSelectedOnTheDefaultPrim) {
  const layer::LayerPtr root = read(kScene);
  const auto session = with_variant(nullptr, *root, "Physics", "b");
  ASSERT_TRUE(session);
  const stage::Stage stage = open(root, *session);
  EXPECT_EQ(stage.default_prim().attribute("n").get_as<std::int32_t>(), 2);
  EXPECT_EQ(with_variant(nullptr, *read("def \"A\" {\n}\n"), "Physics", "b").error().code(),
            ErrorCode::NotFound);
}

TEST(SessionOpinions, OverridesAreReadInTheTypeOfTheAttribute) {
  const layer::LayerPtr root = read(kScene);
  const stage::Stage before = open(root, nullptr);
  const std::vector<std::string> assignments{"/W.mode=y\"z",  "/W.v=(1, 2, 3)",
                                             "/W.file=a.png", "/W.moving=5",
                                             "/W.to=</W>",    "/W.visibility=invisible"};
  const auto session = with_overrides(nullptr, before, assignments);
  ASSERT_TRUE(session) << session.error().to_string();
  const stage::Stage stage = open(root, *session);
  const stage::Prim prim = stage.default_prim();
  EXPECT_EQ(prim.attribute("mode").get_as<Token>(), Token("y\"z"));
  EXPECT_EQ(prim.attribute("v").get_as<Vec3d>(), (Vec3d{{1, 2, 3}}));
  EXPECT_EQ(prim.attribute("file").get_as<layer::AssetPath>()->authored, "a.png");
  EXPECT_EQ(prim.attribute("moving").get_as<float>(0.5), 5.0f);
  EXPECT_EQ(prim.relationship("to").targets(), std::vector{Path::from("/W")});
  EXPECT_EQ(prim.attribute("visibility").get_as<Token>(), Token("invisible"));
}

TEST(SessionOpinions, WhatCannotBeSetIsAnError) {
  const stage::Stage stage = open(read(kScene), nullptr);
  const struct {
    const char* assignment;
    ErrorCode code;
  } cases[] = {
      {"/W.v", ErrorCode::Invalid},          {"/W=3", ErrorCode::Invalid},
      {"/W.v=wrong", ErrorCode::Invalid},    {"/X.v=3", ErrorCode::NotFound},
      {"/W.nothing=3", ErrorCode::NotFound}, {"W.v=(1,2,3)", ErrorCode::Invalid},
  };
  for (const auto& c : cases) {
    const auto session = with_overrides(nullptr, stage, {c.assignment});
    ASSERT_FALSE(session) << c.assignment;
    EXPECT_EQ(session.error().code(), c.code) << c.assignment;
    EXPECT_FALSE(session.error().diagnostic().fix.empty()) << c.assignment;
  }
}

TEST(SessionOpinions, TargetsAreAddedAndTakenAway) {
  const layer::LayerPtr root = read(kScene);
  const stage::Stage stage = open(root, nullptr);
  const auto targets = [&](const std::vector<std::string>& assignments) {
    const auto session = with_overrides(nullptr, stage, assignments);
    EXPECT_TRUE(session);
    std::string names;
    if (session) {
      for (const Path target :
           open(root, *session).prim(Path::from("/W")).relationship(Token("to")).targets()) {
        names += target.str() + " ";
      }
    }
    return names;
  };
  EXPECT_EQ(targets({"/W.to+=/A", "/W.to+=/B", "/W.to+=/A"}), "/W /A /B ");
  EXPECT_EQ(targets({"/W.to+=/A", "/W.to-=/W"}), "/A ");
  EXPECT_EQ(targets({"/W.to=/A", "/W.to+=/B"}), "/A /B ");
  const auto number = with_overrides(nullptr, stage, {"/W.v+=1"});
  ASSERT_FALSE(number);
  EXPECT_EQ(number.error().diagnostic().rule, "edit.type-mismatch");
}

}  // namespace
}  // namespace tenon
