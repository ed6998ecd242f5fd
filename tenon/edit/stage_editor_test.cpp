// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/edit/stage_editor.h"

#include <map>

#include <gtest/gtest.h>

#include "tenon/edit/layer_editor.h"
#include "tenon/formats/text/reader.h"
#include "tenon/formats/text/write/writer.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"

namespace tenon::edit {
namespace {

using layer::Value;

Path at(const char* path) { return Path::from(path); }

// Layers given as text, by name; "root" is the root layer.
StageEditor open_text(const std::map<std::string, std::string>& texts) {
  std::map<std::string, layer::LayerPtr> layers;
  for (const auto& [name, text] : texts) {
    Diagnostics diagnostics;
    auto layer = formats::read_text("#usda 1.0\n" + text, name, diagnostics);
    EXPECT_TRUE(layer) << layer.error().to_string();
    layers[name] = std::make_shared<const layer::Layer>(*std::move(layer));
  }
  auto opener = [layers](const std::string& path, const layer::Layer&) -> Result<layer::LayerPtr> {
    const auto it = layers.find(path);
    return it == layers.end() ? Result<layer::LayerPtr>(Error(ErrorCode::NotFound, "no " + path))
                              : Result<layer::LayerPtr>(it->second);
  };
  return StageEditor::over(layers.at("root"), nullptr, opener);
}

std::string text_of(StageEditor& editor, const std::string& layer) {
  return formats::write_text(*editor.layer(layer));
}

std::string refusal(const Result<void>& result) {
  return result ? "" : result.error().diagnostic().rule;
}

std::vector<std::string> strings(const std::vector<Path>& paths) {
  std::vector<std::string> result;
  for (const Path path : paths) {
    result.push_back(path.str());
  }
  return result;
}

using Strings = std::vector<std::string>;

TEST(StageEditor, MakesASceneInMemory) {
  StageEditor editor = StageEditor::in_memory();
  ASSERT_TRUE(editor.define_prim(at("/World/Ball"), "Sphere"));
  ASSERT_TRUE(editor.set_value(at("/World/Ball.radius"), Value(2.0)));
  ASSERT_TRUE(editor.set_value(at("/World/Ball.radius"), Value(3.0), 24.0));
  ASSERT_TRUE(editor.apply_api(at("/World/Ball"), "PhysicsRigidBodyAPI"));
  ASSERT_TRUE(editor.set_metadata(at("/"), "upAxis", Value(Token("Z"))));
  const auto stage = *editor.stage();
  const stage::Prim ball = stage->prim(at("/World/Ball"));
  EXPECT_EQ(ball.attribute("radius").get_as<double>(24.0), 3.0);
  EXPECT_TRUE(ball.has_api("PhysicsRigidBodyAPI"));
  EXPECT_EQ(stage->metadata("upAxis"), Value(Token("Z")));
  EXPECT_EQ(text_of(editor, "anon:stage.usda"),
            "#usda 1.0\n(\n    upAxis = \"Z\"\n)\n\ndef \"World\"\n{\n    def Sphere \"Ball\" (\n"
            "        prepend apiSchemas = [\"PhysicsRigidBodyAPI\"]\n    )\n    {\n"
            "        double radius = 2\n        double radius.timeSamples = {\n"
            "            24: 3,\n        }\n    }\n}\n\n");
}

TEST(StageEditor, WhatWasHandedOutStaysAsItWas) {
  StageEditor editor = open_text({{"root", "def \"A\" {\n double x = 1\n}\n"}});
  const auto before = *editor.stage();
  ASSERT_TRUE(editor.set_value(at("/A.x"), Value(2.0)));
  const auto after = *editor.stage();
  EXPECT_EQ(before->prim(at("/A")).attribute("x").get_as<double>(), 1.0);
  EXPECT_EQ(after->prim(at("/A")).attribute("x").get_as<double>(), 2.0);
}

TEST(StageEditor, NoticesTellNewPrimsFromNewValues) {
  StageEditor editor = open_text({{"root",
                                   "def \"A\" {\n double x = 1\n def \"B\" {\n }\n}\n"
                                   "def \"C\" (\n references = @ref@</M>\n) {\n}\n"
                                   "def \"I1\" (\n instanceable = true\n references = @ref@</M>\n)"
                                   " {\n}\n"},
                                  {"ref", "def \"M\" {\n def \"P\" {\n double y = 1\n }\n}\n"}});
  ASSERT_TRUE(editor.stage());
  ASSERT_TRUE(editor.set_value(at("/A.x"), Value(2.0)));
  ASSERT_TRUE(editor.create_attribute(at("/A.z"), "int"));
  ASSERT_TRUE(editor.define_prim(at("/A/B/New")));
  ASSERT_TRUE(editor.stage());
  EXPECT_EQ(strings(editor.notice().resynced), (Strings{"/A/B/New", "/A.z"}));
  EXPECT_EQ(strings(editor.notice().changed_info), Strings{"/A.x"});

  ASSERT_TRUE(editor.set_target(*editor.arc_target(at("/C/P"), "ref")));
  ASSERT_TRUE(editor.set_value(at("/C/P.y"), Value(5.0)));
  ASSERT_TRUE(editor.stage());
  EXPECT_TRUE(editor.notice().resynced.empty());
  EXPECT_EQ(strings(editor.notice().changed_info), (Strings{"/C/P.y", "/I1/P.y"}));

  ASSERT_TRUE(editor.set_target("root"));
  ASSERT_TRUE(editor.remove_prim(at("/C")));
  ASSERT_TRUE(editor.set_metadata(at("/A/B"), "documentation", Value(std::string("b"))));
  ASSERT_TRUE(editor.stage());
  EXPECT_EQ(strings(editor.notice().resynced), Strings{"/C"});
  EXPECT_EQ(strings(editor.notice().changed_info), Strings{"/A/B"});
}

TEST(StageEditor, TargetsMapPathsAndTimes) {
  StageEditor editor = open_text(
      {{"root",
        "(\n subLayers = [@sub@ (offset = 10; scale = 2)]\n)\n"
        "def \"A\" (\n references = @ref@</M> (offset = 5)\n) {\n}\n"},
       {"sub", "over \"A\" {\n}\n"},
       {"ref", "def \"M\" {\n double y = 1\n timecode t = 0\n def \"P\" {\n rel r\n }\n}\n"}});
  ASSERT_TRUE(editor.set_target("sub"));
  ASSERT_TRUE(editor.set_value(at("/A.y"), Value(1.5), 30.0));
  EXPECT_NE(text_of(editor, "sub").find("10: 1.5,"), std::string::npos);

  ASSERT_TRUE(editor.set_target(*editor.arc_target(at("/A"), "ref")));
  ASSERT_TRUE(editor.set_value(at("/A.y"), Value(2.5), 30.0));
  ASSERT_TRUE(editor.set_value(at("/A.t"), Value(layer::TimeCode{12})));
  ASSERT_TRUE(editor.edit_targets(at("/A/P.r"), ListEdit<Path>::add(at("/A"))));
  const std::string text = text_of(editor, "ref");
  EXPECT_NE(text.find("25: 2.5,"), std::string::npos) << text;
  EXPECT_NE(text.find("timecode t = 7"), std::string::npos) << text;
  EXPECT_NE(text.find("prepend rel r = </M>"), std::string::npos) << text;
  EXPECT_EQ(refusal(editor.edit_targets(at("/A/P.r"), ListEdit<Path>::add(at("/Other")))),
            "edit.outside-target");
  EXPECT_EQ(refusal(editor.define_prim(at("/Elsewhere"))), "edit.outside-target");
}

TEST(StageEditor, AuthorsInsideVariants) {
  StageEditor editor = open_text({{"root", "def \"A\" {\n double x = 1\n}\n"}});
  ASSERT_TRUE(editor.add_variant(at("/A"), "look", "red"));
  ASSERT_TRUE(editor.set_variant_selection(at("/A"), "look", "red"));
  ASSERT_TRUE(editor.set_target(*editor.variant_target(at("/A"), "look", "red")));
  ASSERT_TRUE(editor.define_prim(at("/A/Red"), "Scope"));
  EXPECT_TRUE(editor.layer("root")->has(at("/A{look=red}Red")));
  EXPECT_EQ((*editor.stage())->prim(at("/A/Red")).type_name(), "Scope");
}

TEST(StageEditor, RefusesWithAReasonAndChangesNothing) {
  StageEditor editor = open_text({{"root",
                                   "def Sphere \"A\" {\n custom rel r\n}\n"
                                   "def \"I\" (\n instanceable = true\n references = @ref@</M>\n)"
                                   " {\n}\n"},
                                  {"ref", "def \"M\" {\n def \"P\" {\n }\n}\n"}});
  const std::string before = text_of(editor, "root");
  EXPECT_EQ(refusal(editor.set_value(at("/A.radius"), Value(1.0f))), "edit.type-mismatch");
  EXPECT_EQ(refusal(editor.set_value(at("/A.none"), Value(1.0f))), "edit.no-property");
  EXPECT_EQ(refusal(editor.set_value(at("/A.r"), Value(1.0f))), "edit.spec-kind");
  EXPECT_EQ(refusal(editor.set_value(at("/B.x"), Value(1.0f))), "edit.no-prim");
  EXPECT_EQ(refusal(editor.define_prim(at("/I/P"), "Scope")), "edit.instance-proxy");
  EXPECT_EQ(refusal(editor.define_prim(at("/I/Deep/Er"))), "edit.instance-proxy");
  EXPECT_EQ(refusal(editor.define_prim(at("A/B"))), "edit.bad-path");
  EXPECT_EQ(refusal(editor.create_attribute(at("/A.x"), "floot")), "edit.unknown-type");
  EXPECT_EQ(refusal(editor.set_metadata(at("/A"), "speed", Value(1))), "edit.unknown-metadata");
  EXPECT_EQ(refusal(editor.set_active(at("/None"), false)), "edit.no-prim");
  EXPECT_EQ(refusal(editor.apply_api(at("/A"), "PhysicsDriveAPI")), "edit.unknown-schema");
  EXPECT_EQ(refusal(editor.add_variant(at("/A"), "look", "a b")), "edit.bad-name");
  EXPECT_EQ(refusal(editor.remove_prim(at("/Gone"))), "edit.no-spec");
  EXPECT_EQ(refusal(editor.set_target("nowhere")), "edit.outside-target");
  EXPECT_EQ(text_of(editor, "root"), before);
  EXPECT_TRUE(editor.changes().empty());
  EXPECT_FALSE(editor.undo());
}

TEST(StageEditor, OversThatSayNothingGoAndAllOthersStay) {
  StageEditor editor = open_text(
      {{"root",
        "(\n subLayers = [@sub@]\n)\nover \"A\" {\n over \"B\" {\n over \"C\" {\n }\n }\n}\n"},
       {"sub", "def \"A\" {\n def \"B\" {\n def \"C\" {\n }\n }\n}\n"}});
  ASSERT_TRUE(editor.set_metadata(at("/A"), "documentation", Value(std::string("kept"))));
  ASSERT_TRUE(editor.remove_silent_prim(at("/A/B/C")));
  EXPECT_TRUE(editor.layer("root")->has(at("/A")));
  EXPECT_FALSE(editor.layer("root")->has(at("/A/B")));
  ASSERT_TRUE(editor.set_target("sub"));
  ASSERT_TRUE(editor.remove_silent_prim(at("/A/B/C")));
  EXPECT_TRUE(editor.layer("sub")->has(at("/A/B/C")));  // it defines the prim
}

TEST(StageEditor, RenamesWithAllThatNamesThePrim) {
  StageEditor editor = open_text(
      {{"root",
        "(\n defaultPrim = \"A\"\n subLayers = [@sub@]\n)\n"
        "def \"A\" {\n def \"B\" {\n double x\n }\n def \"C\" {\n rel r = </A/B.x>\n }\n}\n"
        "def \"D\" (\n inherits = </A/B>\n) {\n}\n"},
       {"sub", "over \"A\" {\n over \"B\" {\n double x = 4\n }\n}\n"}});
  ASSERT_TRUE(editor.rename_prim(at("/A/B"), "Body"));
  ASSERT_TRUE(editor.rename_prim(at("/A"), "Robot"));
  const auto stage = *editor.stage();
  EXPECT_EQ(stage->prim(at("/Robot/Body")).attribute("x").get_as<double>(), 4.0);
  EXPECT_EQ(strings(stage->prim(at("/Robot/C")).relationship("r").targets()),
            Strings{"/Robot/Body.x"});
  EXPECT_EQ(stage->prim(at("/D")).attribute("x").get_as<double>(), 4.0);
  EXPECT_EQ(stage->default_prim().path().str(), "/Robot");
  EXPECT_EQ(strings({stage->prim(at("/Robot")).children()[0].path()}), Strings{"/Robot/Body"});
  EXPECT_EQ(refusal(editor.move_prim(at("/Robot"), at("/Robot/Body/In"))), "edit.bad-move");
  EXPECT_EQ(refusal(editor.rename_prim(at("/Robot/C"), "Body")), "edit.bad-move");
}

TEST(StageEditor, StepsAreTakenBackAndDoneAgain) {
  StageEditor editor = open_text({{"root", "def \"A\" {\n}\n"}});
  const std::string before = text_of(editor, "root");
  ASSERT_TRUE(editor.as_one_step([&]() -> Result<void> {
    TENON_CHECK(editor.define_prim(at("/A/B/C")));
    return editor.create_attribute(at("/A/B.x"), "int");
  }));
  const std::string after = text_of(editor, "root");
  EXPECT_EQ(editor.changes().size(), 1u);
  EXPECT_TRUE(editor.undo());
  EXPECT_EQ(text_of(editor, "root"), before);
  EXPECT_FALSE((*editor.stage())->prim(at("/A/B")).is_valid());
  EXPECT_TRUE(editor.redo());
  EXPECT_EQ(text_of(editor, "root"), after);
  EXPECT_FALSE(editor.as_one_step([&]() -> Result<void> {
    TENON_CHECK(editor.remove_prim(at("/A")));
    return editor.remove_prim(at("/Gone"));
  }));
  EXPECT_EQ(text_of(editor, "root"), after);
  EXPECT_TRUE(editor.undo());
}

TEST(StageEditor, ChangesLeadFromOneLayerToTheOther) {
  StageEditor editor = open_text({{"root", "def \"A\" {\n double x = 1\n}\n"}});
  layer::Layer copy = *editor.layer("root");
  ASSERT_TRUE(editor.set_value(at("/A.x"), Value(2.0)));
  ASSERT_TRUE(editor.define_prim(at("/B")));
  apply(editor.changes().front(), copy);
  EXPECT_EQ(formats::write_text(copy), text_of(editor, "root"));
}

TEST(StageEditor, OpensLayersThatAreInNoFile) {
  StageEditor editor = StageEditor::in_memory();
  layer::Layer part("anon:part.usda");
  LayerEditor writer(part);
  ASSERT_TRUE(writer.create_prim(at("/Part/Pin")));
  editor.add_layer(std::move(part));
  ASSERT_TRUE(editor.define_prim(at("/A")));
  ASSERT_TRUE(editor.edit_references(
      at("/A"), ListEdit<layer::Reference>::add({"anon:part.usda", at("/Part"), {}, {}})));
  ASSERT_TRUE(editor.insert_sublayer(0, "anon:part.usda"));
  const auto stage = *editor.stage();
  EXPECT_TRUE(stage->prim(at("/A/Pin")).is_valid());
  EXPECT_TRUE(stage->prim(at("/Part/Pin")).is_valid());
  EXPECT_EQ(refusal(editor.insert_sublayer(0, "anon:part.usda")), "edit.bad-path");
}

TEST(StageEditor, EditorsUnderTwoSessionsShareLayersAndHistory) {
  StageEditor red = open_text({{"root",
                                "def \"A\" (\n prepend variantSets = \"look\"\n"
                                " variants = {\n string look = \"red\"\n }\n) {\n double x = 1\n"
                                " variantSet \"look\" = {\n \"red\" {\n double own = 1\n }\n"
                                " \"blue\" {\n double own = 2\n }\n }\n}\n"}});
  layer::Layer session("anon:session");
  LayerEditor writer(session);
  ASSERT_TRUE(writer.create_prim(at("/A")));
  writer.set(at("/A"), layer::fields::variantSelection,
             Value(layer::VariantSelections{{{"look", "blue"}}}));
  StageEditor blue = red.under_session(std::make_shared<const layer::Layer>(session));
  const auto value = [](StageEditor& editor, const char* name) {
    return (*editor.stage())->prim(at("/A")).attribute(name).get_as<double>();
  };
  EXPECT_EQ(value(red, "own"), 1.0);
  EXPECT_EQ(value(blue, "own"), 2.0);
  ASSERT_TRUE(red.as_one_step([&]() -> Result<void> {
    TENON_CHECK(red.set_value(at("/A.x"), Value(3.0)));
    TENON_CHECK(blue.set_target(*blue.variant_target(at("/A"), "look", "blue")));
    return blue.set_value(at("/A.own"), Value(4.0));
  }));
  EXPECT_EQ(value(blue, "x"), 3.0);
  EXPECT_EQ(value(red, "own"), 1.0);
  EXPECT_EQ(value(blue, "own"), 4.0);
  EXPECT_EQ(strings(blue.notice().changed_info), (Strings{"/A.own", "/A.x"}));
  EXPECT_TRUE(blue.undo());
  EXPECT_FALSE(red.undo());
  EXPECT_EQ(value(red, "x"), 1.0);
  EXPECT_EQ(value(blue, "own"), 2.0);
}

TEST(StageEditor, ManyEditsBetweenTwoLooksSeeEachOther) {
  StageEditor editor = open_text({{"root", "def \"A\" {\n double x = 1\n}\n"}});
  ASSERT_TRUE(editor.stage());
  ASSERT_TRUE(editor.set_value(at("/A.x"), Value(2.0)));
  ASSERT_TRUE(editor.create_attribute(at("/A.y"), "double"));
  ASSERT_TRUE(editor.set_value(at("/A.y"), Value(3.0)));
  ASSERT_TRUE(editor.define_prim(at("/A/B"), "Sphere"));
  ASSERT_TRUE(editor.set_value(at("/A/B.radius"), Value(4.0)));
  ASSERT_TRUE(editor.apply_api(at("/A/B"), "PhysicsMassAPI"));
  ASSERT_TRUE(editor.set_value(at("/A/B.physics:mass"), Value(5.0f)));
  // A refused edit takes back what it had made, and what looked at that forgets it.
  EXPECT_EQ(refusal(editor.set_value(at("/A/B.radius"), Value(1))), "edit.type-mismatch");
  EXPECT_FALSE(editor.as_one_step([&]() -> Result<void> {
    TENON_CHECK(editor.define_prim(at("/A/B/C")));
    return editor.remove_prim(at("/Gone"));
  }));
  EXPECT_EQ(refusal(editor.set_value(at("/A/B/C.x"), Value(1.0))), "edit.no-prim");
  EXPECT_TRUE(editor.undo());
  EXPECT_TRUE(editor.undo());
  EXPECT_EQ(refusal(editor.set_value(at("/A/B.physics:mass"), Value(5.0f))), "edit.no-property");
  EXPECT_TRUE(editor.undo());
  EXPECT_TRUE(editor.undo());
  EXPECT_EQ(refusal(editor.set_value(at("/A/B.radius"), Value(4.0))), "edit.no-prim");
  const auto stage = *editor.stage();
  EXPECT_EQ(stage->prim(at("/A")).attribute("x").get_as<double>(), 2.0);
  EXPECT_EQ(stage->prim(at("/A")).attribute("y").get_as<double>(), 3.0);
}

TEST(StageEditor, WithdrawnSchemasLeaveNothingBehind) {
  StageEditor editor = open_text({{"root", "(\n subLayers = [@sub@]\n)\ndef \"A\" {\n}\n"},
                                  {"sub",
                                   "over \"A\" (\n prepend apiSchemas = [\"PhysicsMassAPI\"]\n)"
                                   " {\n}\n"}});
  const std::string before = text_of(editor, "root");
  const auto applied = [&] { return (*editor.stage())->prim(at("/A")).authored_api_schemas(); };
  ASSERT_TRUE(editor.remove_api(at("/A"), "PhysicsMassAPI"));
  EXPECT_TRUE(applied().empty());
  ASSERT_TRUE(editor.withdraw_applied_schema(at("/A"), "PhysicsMassAPI"));
  EXPECT_EQ(applied(), std::vector<Token>{"PhysicsMassAPI"});
  ASSERT_TRUE(editor.apply_api(at("/A"), "PhysicsRigidBodyAPI"));
  ASSERT_TRUE(editor.withdraw_applied_schema(at("/A"), "PhysicsRigidBodyAPI"));
  EXPECT_EQ(text_of(editor, "root"), before);
}

TEST(StageEditor, AValueFitsTheTypeUnderWhichItsLayerHasTheAttribute) {
  StageEditor editor = open_text({{"root", "def Cube \"A\" {\n float size = 1\n}\n"}});
  EXPECT_TRUE(editor.set_value(at("/A.size"), Value(2.0f)));
  EXPECT_TRUE(editor.set_value(at("/A.size"), Value(2.0)));
  EXPECT_EQ(refusal(editor.set_value(at("/A.size"), Value(2))), "edit.type-mismatch");
}

}  // namespace
}  // namespace tenon::edit
