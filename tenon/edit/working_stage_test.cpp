// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <memory>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "tenon/edit/layer_editor.h"
#include "tenon/edit/stage_editor.h"
#include "tenon/formats/text/reader.h"
#include "tenon/formats/text/write/writer.h"
#include "tenon/layer/fields.h"
#include "tenon/stage/flatten/flatten.h"

namespace tenon::edit {
namespace {

using layer::Value;

Path path_of(const std::string& text) { return Path::from(text); }

/// An editor of layers given as text, by name, "root" first; and whether its working stage stays.
class WorkingStageTest : public testing::Test {
 protected:
  void open(const std::map<std::string, std::string>& texts) {
    for (const auto& [name, text] : texts) {
      Diagnostics found;
      auto layer = formats::read_text("#usda 1.0\n" + text, name, found);
      ASSERT_TRUE(layer) << layer.error().to_string();
      layers_[name] = std::make_shared<const layer::Layer>(*std::move(layer));
    }
    editor_.emplace(StageEditor::over(layers_.at("root"), nullptr, opener(false)));
    stage_ = *editor_->working_stage();
  }
  StageEditor& editor() { return *editor_; }
  const stage::Stage& stage() { return *stage_; }

  /// After an edit: the scene is right, and the same one as before.
  void expect_followed(const Result<void>& edit) {
    ASSERT_TRUE(edit) << edit.error().to_string();
    const auto before = stage_;
    expect_right();
    EXPECT_EQ(stage_, before);
  }
  void expect_another(const Result<void>& edit) {
    ASSERT_TRUE(edit) << edit.error().to_string();
    const auto before = stage_;
    expect_right();
    EXPECT_NE(stage_, before);
  }
  /// The scene is the one that is composed of the layers as they are now.
  void expect_right() {
    stage_ = *editor_->working_stage();
    const auto fresh = stage::Stage::open(now("root"), nullptr, opener(true));
    ASSERT_TRUE(fresh);
    EXPECT_EQ(formats::write_text(stage::flatten(*stage_)),
              formats::write_text(stage::flatten(*fresh)));
  }

 private:
  layer::LayerPtr now(const std::string& name) {
    const auto edited = editor_->edited_layers();
    const auto found = edited.find(name);
    return found == edited.end() ? layers_.at(name) : found->second;
  }
  compose::LayerOpener opener(bool edited) {
    return [this, edited](const std::string& name, const layer::Layer&) -> Result<layer::LayerPtr> {
      if (!layers_.contains(name)) {
        return Error(ErrorCode::NotFound, "no " + name);
      }
      return edited ? now(name) : layers_.at(name);
    };
  }

  std::map<std::string, layer::LayerPtr> layers_;
  std::optional<StageEditor> editor_;
  std::shared_ptr<const stage::Stage> stage_;
};

TEST_F(WorkingStageTest, ValuesPropertiesTypesAndSchemasAreFollowed) {
  open({{"root", "def Cube \"A\" {\n double size = 1\n}\ndef Cube \"B\" {\n}\n"}});
  expect_followed(editor().set_value(path_of("/A.size"), Value(2.0)));
  EXPECT_EQ(stage().prim(path_of("/A")).attribute("size").get_as<double>(), 2.0);
  expect_followed(editor().set_value(path_of("/B.size"), Value(3.0)));
  EXPECT_EQ(stage().prim(path_of("/B")).attribute("size").get_as<double>(), 3.0);
  expect_followed(editor().create_attribute(path_of("/B.own"), "double"));
  expect_followed(editor().remove_property(path_of("/A.size")));
  EXPECT_EQ(stage().prim(path_of("/A")).attribute("size").get_as<double>(), 2.0);  // the fallback
  expect_followed(editor().apply_api(path_of("/A"), "PhysicsMassAPI"));
  EXPECT_TRUE(stage().prim(path_of("/A")).has_api("PhysicsMassAPI"));
  expect_followed(editor().set_type_name(path_of("/B"), "Sphere"));
  EXPECT_EQ(stage().prim(path_of("/B")).attribute("radius").get_as<double>(), 1.0);
  while (editor().undo()) {
    expect_followed({});
  }
  while (editor().redo()) {
    expect_followed({});
  }
}

TEST_F(WorkingStageTest, NewPrimsAreFollowed) {
  open({{"root", "def \"W\" {\n def Cube \"A\" {\n }\n}\n"}});
  expect_followed(editor().define_prim(path_of("/W/B"), "Cube"));
  expect_followed(editor().define_prim(path_of("/W/B/C/D"), "Sphere"));
  expect_followed(editor().set_value(path_of("/W/B/C/D.radius"), Value(2.0)));
  expect_followed(editor().apply_api(path_of("/W/B/C/D"), "PhysicsMassAPI"));
  expect_followed(editor().define_prim(path_of("/X"), "Cube"));
  expect_another(editor().create_class(path_of("/_c")));  // it is a def first
  expect_another(editor().remove_prim(path_of("/W/A")));
  expect_followed(editor().define_prim(path_of("/W/A"), "Cube"));
  while (editor().undo()) {
    expect_right();
  }
  EXPECT_EQ(stage().prim(path_of("/W")).children().size(), 1u);
}

TEST_F(WorkingStageTest, OnePrimOfManyLayersIsFollowedWhereverItCounts) {
  open({{"root",
         "(\n subLayers = [@sub@]\n)\ndef \"A\" (references = @part@</P>) {\n}\n"
         "def \"B\" (references = @part@</P>) {\n}\n"},
        {"sub", "over \"A\" {\n over \"pin\" {\n }\n}\n"},
        {"part", "def \"P\" {\n def Cube \"pin\" {\n  double size = 1\n }\n}\n"}});
  ASSERT_TRUE(editor().set_target(*editor().arc_target(path_of("/A/pin"), "part")));
  expect_followed(editor().set_value(path_of("/A/pin.size"), Value(4.0)));
  EXPECT_EQ(stage().prim(path_of("/B/pin")).attribute("size").get_as<double>(), 4.0);
  expect_followed(editor().apply_api(path_of("/A/pin"), "PhysicsMassAPI"));
  EXPECT_TRUE(stage().prim(path_of("/B/pin")).has_api("PhysicsMassAPI"));
  expect_followed(editor().define_prim(path_of("/A/hole"), "Cube"));
  EXPECT_TRUE(stage().prim(path_of("/B/hole")).is_valid());
  ASSERT_TRUE(editor().set_target("sub"));
  expect_followed(editor().set_value(path_of("/A/pin.size"), Value(5.0)));
  // The first opinion of a layer on a prim that others have.
  expect_another(editor().set_value(path_of("/B/pin.size"), Value(6.0)));
  EXPECT_EQ(stage().prim(path_of("/A/pin")).attribute("size").get_as<double>(), 5.0);
}

TEST_F(WorkingStageTest, APrimThatArcsWaitForTakesAnotherScene) {
  open({{"root",
         "def \"A\" (inherits = </_class>) {\n}\n"
         "def \"B\" (references = </W/late>) {\n}\ndef \"W\" {\n}\n"}});
  expect_another(editor().create_class(path_of("/_class")));
  expect_followed(editor().define_prim(path_of("/_class/part"), "Cube"));
  EXPECT_TRUE(stage().prim(path_of("/A/part")).is_valid());
  expect_another(editor().define_prim(path_of("/W/late"), "Cube"));
  EXPECT_EQ(stage().prim(path_of("/B")).type_name(), "Cube");
}

TEST_F(WorkingStageTest, APrimThatAnArcToAnEmptyLayerWaitsForTakesAnotherScene) {
  open({{"root", "def \"A\" (references = [@part@</P/Q>, @own@]) {\n}\n"},
        {"part", ""},
        {"own", "(\n defaultPrim = \"O\"\n)\n"}});
  const auto create = [](const char* path) {
    return [path](LayerEditor& specs) { return specs.create_prim(path_of(path)); };
  };
  expect_another(editor().edit_layer("part", create("/P/Q/R")));
  EXPECT_TRUE(stage().prim(path_of("/A/R")).is_valid());
  expect_another(editor().edit_layer("own", create("/O/S")));
  EXPECT_TRUE(stage().prim(path_of("/A/S")).is_valid());
}

TEST_F(WorkingStageTest, InstancesAreFollowedInWhatTheyShare) {
  open({{"root",
         "def \"A\" (instanceable = true\n references = @part@</P>) {\n}\n"
         "def \"B\" (instanceable = true\n references = @part@</P>) {\n}\n"},
        {"part", "def \"P\" {\n def Cube \"pin\" {\n  double size = 1\n }\n}\n"}});
  const auto shared = [](LayerEditor& specs) -> Result<void> {
    specs.set(path_of("/P/pin.size"), layer::fields::default_value, Value(2.0));
    return {};
  };
  expect_followed(editor().edit_layer("part", shared));
  EXPECT_EQ(stage().prim(path_of("/B/pin")).attribute("size").get_as<double>(), 2.0);
  const auto added = [](LayerEditor& specs) { return specs.create_prim(path_of("/P/hole")); };
  expect_another(editor().edit_layer("part", added));
}

TEST_F(WorkingStageTest, WhatWasHandedOutStaysAsItWas) {
  open({{"root", "def Cube \"A\" {\n double size = 1\n}\n"}});
  const auto kept = *editor().stage();
  const layer::LayerPtr layer = editor().layer("root");
  expect_another(editor().set_value(path_of("/A.size"), Value(2.0)));
  expect_followed(editor().set_value(path_of("/A.size"), Value(3.0)));
  EXPECT_EQ(kept->prim(path_of("/A")).attribute("size").get_as<double>(), 1.0);
  EXPECT_EQ(layer->find(path_of("/A.size"))->get_or(layer::fields::default_value, 0.0), 1.0);
  EXPECT_FALSE(editor().set_value(path_of("/A.size"), Value(1)));  // refused: of another type
  expect_right();
  EXPECT_EQ(stage().prim(path_of("/A")).attribute("size").get_as<double>(), 3.0);
  EXPECT_EQ(editor().step_count(), 2u);
}

TEST_F(WorkingStageTest, AnEditOfALayerThatTheSceneLacksLeavesItAlone) {
  open({{"root",
         "def \"A\" (\n prepend variantSets = \"v\"\n variants = {\n string v = \"x\"\n }\n)"
         " {\n variantSet \"v\" = {\n \"x\" {\n }\n"
         " \"y\" (references = @part@</P>) {\n }\n }\n}\n"},
        {"part", "def \"P\" {\n def Cube \"pin\" {\n }\n}\n"}});
  layer::Layer session("session");
  LayerEditor writer(session);
  ASSERT_TRUE(writer.create_prim(path_of("/A")));
  writer.select_variant(path_of("/A"), "v", "y");
  StageEditor other = editor().under_session(std::make_shared<const layer::Layer>(session));
  ASSERT_TRUE(other.working_stage());
  const auto remove = [](LayerEditor& specs) { return specs.remove_prim(path_of("/P/pin")); };
  expect_followed(other.edit_layer("part", remove));
  EXPECT_FALSE((*other.working_stage())->prim(path_of("/A/pin")).is_valid());
}

}  // namespace
}  // namespace tenon::edit
