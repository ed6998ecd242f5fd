// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/edit_asset.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace tenon {
namespace {

namespace fs = std::filesystem;

AssetEdit set(const char* property, const char* value, const char* type = "") {
  AssetEdit edit;
  edit.object = Path::from(property);
  edit.value = value;
  edit.type_name = Token(type);
  return edit;
}

AssetEdit about_api(AssetEdit::Kind kind, const char* prim, const char* api) {
  AssetEdit edit;
  edit.kind = kind;
  edit.object = Path::from(prim);
  edit.api = Token(api);
  return edit;
}

class AssetEdits : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(testing::TempDir()) /
        ("tenon_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << "#usda 1.0\n" << text;
    return (folder_ / name).string();
  }
  AssetEditor open(const std::string& path, const EditOptions& options = {}) {
    auto editor = AssetEditor::open(path, options, diagnostics_);
    EXPECT_TRUE(editor) << editor.error().to_string();
    return *std::move(editor);
  }
  static std::string only_text(const AssetEditor& editor) {
    const auto files = editor.files();
    EXPECT_TRUE(files) << files.error().to_string();
    return files->size() == 1 ? files->front().after : std::to_string(files->size()) + " files";
  }
  static std::string refusal(const Result<std::vector<EditedPlace>>& done) {
    return done ? "" : done.error().diagnostic().rule;
  }

  fs::path folder_;
  Diagnostics diagnostics_;
};

TEST_F(AssetEdits, ACallIsOneStepThatUndoTakesBack) {
  AssetEditor editor = open(write("a.usda", "def Cube \"A\" {\n    double size = 1\n}\n"));
  ASSERT_TRUE(editor.edit({set("/A.size", "2"), set("/A.visibility", "invisible")}, diagnostics_));
  ASSERT_TRUE(editor.edit({set("/A.size", "3")}, diagnostics_));
  EXPECT_NE(only_text(editor).find("double size = 3"), std::string::npos);
  EXPECT_TRUE(editor.undo());
  EXPECT_NE(only_text(editor).find("double size = 2"), std::string::npos);
  const auto again = editor.edit({set("/A.size", "4")}, diagnostics_);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->front().before, "2");
  EXPECT_EQ(again->front().after, "4");
  EXPECT_TRUE(editor.undo());
  EXPECT_TRUE(editor.undo());
  EXPECT_EQ(only_text(editor), "0 files");
  EXPECT_FALSE(editor.undo());
  EXPECT_TRUE(editor.redo());
  EXPECT_NE(only_text(editor).find("invisible"), std::string::npos);
}

TEST_F(AssetEdits, ARefusedCallLeavesNothing) {
  AssetEditor editor = open(write("a.usda", "def Cube \"A\" {\n    double size = 1\n}\n"));
  EXPECT_EQ(refusal(editor.edit({set("/A.size", "2"), set("/B.size", "3")}, diagnostics_)),
            "edit.no-prim");
  EXPECT_EQ(only_text(editor), "0 files");
  const auto done = editor.edit({set("/A.size", "5")}, diagnostics_);
  ASSERT_TRUE(done);
  EXPECT_EQ(done->front().before, "1");
}

TEST_F(AssetEdits, LaterEditsOfOneThingSeeTheEarlierOnes) {
  AssetEditor editor = open(write("a.usda", "def Cube \"A\" {\n    double size = 1\n}\n"));
  const auto done = editor.edit(
      {set("/A.size", "2"), about_api(AssetEdit::Kind::ApplyApi, "/A", "PhysicsMassAPI"),
       set("/A.physics:mass", "7"), set("/A.size", "3"), set("/A.note", "x", "string"),
       set("/A.note", "y")},
      diagnostics_);
  ASSERT_TRUE(done) << done.error().to_string();
  EXPECT_EQ(done->at(3).before, "2");
  EXPECT_EQ(done->at(5).before, "\"x\"");
  EXPECT_EQ(done->at(5).after, "\"y\"");
}

// Both prims have what the class says: the second edit writes where the first one reads.
TEST_F(AssetEdits, EditsThatMeetInOneSpecAreProvedOneAfterTheOther) {
  const std::string path = write("a.usda",
                                 "class \"_c\" {\n    double x = 1\n}\n"
                                 "def \"A\" (\n    inherits = </_c>\n) {\n}\n"
                                 "def \"B\" (\n    inherits = </_c>\n) {\n}\n");
  AssetEditor editor = open(path);
  const auto done =
      editor.edit({set("/_c.x", "2"), set("/A.x", "3"), set("/B.x", "4")}, diagnostics_);
  ASSERT_TRUE(done) << done.error().to_string();
  EXPECT_EQ(done->at(1).before, "2");
  EXPECT_EQ(done->at(1).after, "3");
  EXPECT_EQ(done->at(2).before, "2");
}

TEST_F(AssetEdits, SchemasThatComeAndGoLeaveTheFileAsItWas) {
  write("weak.usda", "def Cube \"A\" (\n    prepend apiSchemas = [\"PhysicsMassAPI\"]\n) {\n}\n");
  const std::string path =
      write("a.usda", "(\n    subLayers = [@./weak.usda@]\n)\nover \"A\" {\n}\n");
  EditOptions options;
  options.layer = "a.usda";
  AssetEditor editor = open(path, options);
  const auto step = [&](AssetEdit::Kind kind, const char* api) {
    const auto done = editor.edit({about_api(kind, "/A", api)}, diagnostics_);
    EXPECT_TRUE(done) << done.error().to_string();
  };
  step(AssetEdit::Kind::ApplyApi, "PhysicsRigidBodyAPI");
  EXPECT_NE(only_text(editor).find("PhysicsRigidBodyAPI"), std::string::npos);
  step(AssetEdit::Kind::RemoveApi, "PhysicsRigidBodyAPI");
  EXPECT_EQ(only_text(editor), "0 files");
  step(AssetEdit::Kind::RemoveApi, "PhysicsMassAPI");
  EXPECT_NE(only_text(editor).find("delete apiSchemas"), std::string::npos);
  step(AssetEdit::Kind::ApplyApi, "PhysicsMassAPI");
  EXPECT_EQ(only_text(editor).find("delete apiSchemas"), std::string::npos);
}

TEST_F(AssetEdits, ScenesFollowEditsOfAllVariantsUnlessTheyAreToStay) {
  write("part.usda",
        "(\n    defaultPrim = \"P\"\n)\ndef \"P\" {\n    def Cube \"X\" {\n    }\n}\n");
  const std::string both = "prepend references = @./part.usda@\n";
  AssetEditor editor = open(
      write("a.usda",
            "(\n    defaultPrim = \"A\"\n)\ndef \"A\" (\n    prepend variantSets = \"Physics\"\n"
            "    variants = {\n        string Physics = \"one\"\n    }\n) {\n"
            "    variantSet \"Physics\" = {\n        \"one\" (" +
                both +
                ") {\n        }\n"
                "        \"two\" (" +
                both + ") {\n        }\n    }\n}\n"));
  const auto sizes = [](const std::vector<AssetEditor::View>& views) {
    std::vector<double> all;
    for (const AssetEditor::View& view : views) {
      all.push_back(
          view.stage->prim(Path::from("/A/X")).attribute("size").get_as<double>().value_or(0));
    }
    return all;
  };
  const auto working = *editor.working_views();
  ASSERT_EQ(working.size(), 2u);
  AssetEdit edit = set("/A/X.size", "4");
  edit.layer = "part.usda";
  ASSERT_TRUE(editor.edit({edit}, diagnostics_));
  AssetEdit api = about_api(AssetEdit::Kind::ApplyApi, "/A/X", "PhysicsMassAPI");
  api.layer = "part.usda";
  ASSERT_TRUE(editor.edit({api}, diagnostics_));
  EXPECT_EQ(sizes(working), (std::vector{4.0, 4.0}));
  const auto kept = *editor.views();
  EXPECT_EQ(kept.front().stage, working.front().stage);
  edit.value = "5";
  ASSERT_TRUE(editor.edit({edit}, diagnostics_));
  EXPECT_EQ(sizes(kept), (std::vector{4.0, 4.0}));
  EXPECT_EQ(sizes(*editor.working_views()), (std::vector{5.0, 5.0}));
  EXPECT_EQ(editor.step_count(), 3u);
  ASSERT_TRUE(editor.edit({edit}, diagnostics_));  // changes nothing
  EXPECT_EQ(editor.step_count(), 3u);
}

// Two instances share one prototype, which is made of the first: an edit below the second one has
// to find the names of the shared file all the same.
TEST_F(AssetEdits, TargetsBelowAnyInstanceAreNamedAsItsFileDoes) {
  write("part.usda",
        "(\n    defaultPrim = \"P\"\n)\ndef \"P\" {\n    def \"X\" {\n    rel r\n    }\n"
        "    def \"Y\" {\n    }\n}\n");
  const std::string path =
      write("a.usda",
            "def \"I1\" (\n    instanceable = true\n    references = @./part.usda@\n) {\n}\n"
            "def \"I2\" (\n    instanceable = true\n    references = @./part.usda@\n) {\n}\n");
  for (const std::string instance : {"/I1", "/I2"}) {
    AssetEditor editor = open(path);
    const std::string property = instance + "/X.r";
    const std::string target = instance + "/Y";
    const auto done = editor.edit({set(property.c_str(), target.c_str())}, diagnostics_);
    ASSERT_TRUE(done) << done.error().to_string();
    EXPECT_EQ(done->front().spec.str(), "/P/X.r");
    EXPECT_EQ(done->front().after, "<" + target + ">");
    EXPECT_NE(only_text(editor).find("rel r = </P/Y>"), std::string::npos) << only_text(editor);
    EXPECT_EQ(refusal(editor.edit({set(property.c_str(), "/Elsewhere")}, diagnostics_)),
              "edit.outside-target");
  }
}

TEST_F(AssetEdits, SamplesMetadataAndWhatIsInVariants) {
  AssetEditor editor = open(write("a.usda", "def Cube \"A\" {\n    double size = 1\n}\n"));
  AssetEdit sample = set("/A.size", "3");
  sample.time = 10;
  AssetEdit data;
  data.kind = AssetEdit::Kind::SetMetadata;
  data.object = Path::from("/A");
  data.field = Token("customData");
  data.key = "a:b";
  data.value = "{\nint value = 7\n}";
  AssetEdit inside = set("/A.visibility", "invisible");
  inside.inside = VariantPlace{Path::from("/A"), "look", "dark"};
  AssetEdit variant;
  variant.kind = AssetEdit::Kind::AddVariant;
  variant.object = Path::from("/A");
  variant.value = "look=dark";
  const auto done = editor.edit({sample, data, variant, inside}, diagnostics_);
  ASSERT_TRUE(done) << done.error().to_string();
  EXPECT_EQ(done->back().spec.str(), "/A{look=dark}.visibility");
  const auto shown = [&] { return editor.working_views()->front().stage->prim(Path::from("/A")); };
  EXPECT_EQ(shown().attribute("size").get_as<double>(10.0).value_or(0), 3);
  EXPECT_NE(shown().attribute("visibility").get_as<Token>().value_or(Token()), "invisible");
  AssetEdit select = variant;
  select.kind = AssetEdit::Kind::SelectVariant;
  ASSERT_TRUE(editor.edit({select}, diagnostics_));
  EXPECT_EQ(shown().attribute("visibility").get_as<Token>().value_or(Token()), "invisible");
  select.value = "look=drak";
  EXPECT_EQ(refusal(editor.edit({select}, diagnostics_)), "edit.no-variant");
  AssetEdit arc;
  arc.kind = AssetEdit::Kind::AddArc;
  arc.object = Path::from("/A");
  arc.arc = AssetArc{.prim = Path::from("/B")};
  EXPECT_EQ(refusal(editor.edit({arc}, diagnostics_)), "edit.no-target");
}

}  // namespace
}  // namespace tenon
