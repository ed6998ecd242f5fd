// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What the command tells is asked here without the command.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "tenon/asset/answers/edited_json.h"
#include "tenon/asset/answers/package_json.h"
#include "tenon/asset/answers/parts_json.h"
#include "tenon/asset/checking/check_assets.h"
#include "tenon/asset/checking/checked_json.h"
#include "tenon/asset/comparing/compare_files.h"
#include "tenon/asset/edit_request.h"
#include "tenon/asset/layers/select_variant.h"
#include "tenon/asset/layers/strip_asset.h"
#include "tenon/asset/missing_input.h"
#include "tenon/asset/simulating/simulate_asset.h"
#include "tenon/asset/simulating/simulated_json.h"
#include "tenon/pack_asset.h"

namespace tenon {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBox = R"(#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "World" (
    variants = {
        string Physics = "physics"
    }
    prepend variantSets = "Physics"
)
{
    def Cube "box" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMassAPI"]
    )
    {
        float physics:mass = 2
        double3 xformOp:translate = (0, 0, 3)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    variantSet "Physics" = {
        "none" {
        }
        "physics" {
        }
    }
}
)";

class AssetAnswers : public testing::Test {
 protected:
  AssetAnswers() {
    std::string name = (fs::temp_directory_path() / "tenon_answers_XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    box_ = write("box.usda", kBox);
  }
  ~AssetAnswers() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  std::string write(const std::string& name, const std::string& text) const {
    const fs::path path = folder_ / name;
    std::ofstream(path) << text;
    return path.string();
  }

  fs::path folder_;
  std::string box_;
  Diagnostics diagnostics_;
};

TEST_F(AssetAnswers, CheckTellsOfEachAssetOnce) {
  std::size_t told = 0;
  CheckAssetsOptions options;
  options.progress = [&](std::size_t, std::size_t total) { told += total; };
  const auto checked = check_assets({box_, box_, folder_.string()}, options);
  ASSERT_TRUE(checked) << checked.error().message();
  EXPECT_EQ(told, 1U);
  EXPECT_TRUE(checked->all_opened());
  const answers::Json json = checked_json(*checked, "");
  EXPECT_EQ(json["assets"][0]["variants"].size(), 2U);
  EXPECT_FALSE(json.contains("corrected"));
  EXPECT_EQ(json["summary"]["errors"].get<std::size_t>(), count_findings(checked->findings).errors);
  options.check.rules.only = {"no-such-rule"};
  EXPECT_FALSE(check_selection(options.check.rules));
}

TEST_F(AssetAnswers, EditsComeAsFilesAndAsJson) {
  EditRequest request;
  request.mass = {"/World/box=4"};
  request.clear = {"/World/box.xformOp:translate"};
  const auto edits = read_edits(box_, request, {});
  ASSERT_TRUE(edits) << edits.error().message();
  const auto edited = edit_asset(box_, *edits, {}, diagnostics_);
  ASSERT_TRUE(edited) << edited.error().message();
  const answers::Json json = edited_json(*edits, *edited, true);
  EXPECT_NE(json["files"][0]["diff"].get<std::string>().find("physics:mass = 4"),
            std::string::npos);
  EXPECT_EQ(json["written"], false);
  EXPECT_EQ(edited_json(*edits, *edited, false)["written"], true);
  EXPECT_FALSE(read_edits(box_, {}, {}));
}

TEST_F(AssetAnswers, FilesArePairedAndCompared) {
  const std::string other = write("other.usda", std::string(kBox) + "def \"More\" {\n}\n");
  const auto compared = compare_files(box_, other, {}, diagnostics_);
  ASSERT_TRUE(compared) << compared.error().message();
  EXPECT_FALSE(compared->equal());
  const answers::Json json = compared_json(box_, other, *compared);
  EXPECT_EQ(json["mode"], "layers");
  EXPECT_EQ(json["differences"][0]["path"], "/More");
  const auto added = compare_files(kNoFile, folder_.string(), {}, diagnostics_);
  ASSERT_TRUE(added);
  EXPECT_EQ(added->mode, "packages");
  EXPECT_EQ(added->differences.size(), 2U);
}

TEST_F(AssetAnswers, StrippingTouchesNoFile) {
  StripOptions options;
  options.output = (folder_ / "bare.usda").string();
  const auto stripped = strip_asset(box_, options, diagnostics_);
  ASSERT_TRUE(stripped) << stripped.error().message();
  ASSERT_EQ(stripped->files.size(), 1U);
  EXPECT_EQ(stripped->files[0].contents.find("Physics"),
            stripped->files[0].contents.find("Physics ="));
  EXPECT_EQ(stripped_json(*stripped)["apiSchemas"], 3);
  EXPECT_FALSE(fs::exists(options.output));
  const auto muted = mute_asset(box_, options, diagnostics_);
  ASSERT_TRUE(muted);
  EXPECT_EQ(muted_json(muted->counts)["bodies"], 1);
}

TEST_F(AssetAnswers, ASelectionOfAPackageLiesOverIt) {
  const auto packed = pack_asset(box_, {}, diagnostics_);
  ASSERT_TRUE(packed);
  const std::string package = write("box.usdz", packed->package);
  const auto entries = list_package(package, {});
  ASSERT_TRUE(entries);
  EXPECT_TRUE(package_list_json(*entries)["files"][0]["aligned"].get<bool>());
  SelectOptions options;
  options.assignment = "Physics=none";
  options.output = (folder_ / "none.usda").string();
  const auto selected = select_variant(package, options, diagnostics_);
  ASSERT_TRUE(selected) << selected.error().message();
  EXPECT_TRUE(selected->is_layer_over);
  EXPECT_NE(selected->file.contents.find("@./box.usdz"), std::string::npos)
      << selected->file.contents;
  options.assignment = "Physics=gone";
  EXPECT_FALSE(select_variant(package, options, diagnostics_));
}

TEST_F(AssetAnswers, ARunIsAValue) {
  const OptionalParts parts = optional_parts();
  const bool available =
      std::any_of(parts.engines.begin(), parts.engines.end(),
                  [](const OptionalPart& part) { return part.name == "mujoco" && part.available; });
  if (!available) {
    GTEST_SKIP() << "MuJoCo is not installed";
  }
  SimulateAssetOptions options;
  options.duration = 0.1;
  std::vector<std::string> told;
  options.listener.next_part = [&](const std::string& part) { told.push_back(part); };
  // A finding in another asset is not about this one.
  Diagnostic of_another;
  of_another.rule = "drive.negative-gain";
  diagnostics_.add(of_another);
  const auto run = simulate_asset(box_, options, diagnostics_);
  ASSERT_TRUE(run) << run.error().message();
  EXPECT_EQ(told.back(), "simulating");
  const answers::Json json = simulated_json(*run, false);
  const double height = json["bodies"]["/World/box"]["position"][2].get<double>();
  EXPECT_NEAR(height, 3 - 0.5 * 9.81 * 0.01, 0.02);  // free fall for 0.1 s
  EXPECT_EQ(motion_json(*run, "x.usda")["bodies"], 1);
  options.listener.go_on = [](double, double) { return false; };
  const auto stopped = simulate_asset(box_, options, diagnostics_);
  ASSERT_TRUE(stopped);
  EXPECT_TRUE(stopped->run.interrupted);
  options.duration = 1e6;
  options.frames_per_second = 1e5;
  EXPECT_EQ(simulate_asset(box_, options, diagnostics_).error().code(), ErrorCode::Limit);
}

}  // namespace
}  // namespace tenon
