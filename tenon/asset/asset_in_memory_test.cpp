// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Whole assets read from memory: nothing of them is on the disk, and everything is as from there.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include <gtest/gtest.h>
#include <stdlib.h>

#include "tenon/answers/dump/stage_dump.h"
#include "tenon/answers/scene_json.h"
#include "tenon/asset/check_asset.h"
#include "tenon/asset/convert_file.h"
#include "tenon/asset/edit_asset.h"
#include "tenon/asset/structure_asset.h"
#include "tenon/bytes/read_record.h"
#include "tenon/bytes/zip/zip_archive.h"
#include "tenon/open_stage.h"
#include "tenon/pack_asset.h"
#include "tenon/physics/read_physics.h"

namespace tenon {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPng = "\x89PNG\r\n\x1a\n";

std::string contents_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Files of a folder by their names below it.
std::map<std::string, std::string> files_of(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files.emplace(fs::relative(entry.path(), folder).generic_string(), contents_of(entry.path()));
    }
  }
  return files;
}

/// The same under a made-up root.
bytes::Files in_memory(const std::map<std::string, std::string>& files, const std::string& root) {
  bytes::FileMap map;
  for (const auto& [name, contents] : files) {
    map.emplace(root + "/" + name, bytes::FileBytes::own(contents));
  }
  return bytes::Files::in_memory(std::move(map));
}

OpenOptions reading(bytes::Files files) {
  OpenOptions options;
  options.files = std::move(files);
  return options;
}

/// `text` with the asset's folder as "<root>".
std::string without(const std::string& root, std::string text) {
  for (std::size_t at = text.find(root); at != std::string::npos; at = text.find(root, at)) {
    text.replace(at, root.size(), "<root>");
  }
  return text;
}

std::string told(const Diagnostic& d) {
  return std::string(severity_name(d.severity)) + " " + d.rule + " " + d.file + ":" +
         std::to_string(d.line) + ":" + std::to_string(d.column) + " " + d.prim + " " + d.property +
         " " + d.message + "\n";
}

/// What is said about an asset, with its folder as "<root>".
struct Answers {
  std::string dump;
  std::string physics;
  std::string findings;
  std::string diagnostics;
  std::string package;
};

Answers answers_of(const std::string& root, const std::string& name, const OpenOptions& open) {
  Answers answers;
  const std::string path = root + "/" + name;
  Diagnostics diagnostics;
  const auto stage = tenon::open(path, open, diagnostics);
  EXPECT_TRUE(stage) << (stage ? "" : stage.error().diagnostic().message);
  if (!stage) {
    return answers;
  }
  std::ostringstream dump;
  answers::write_stage_dump(*stage, {.stacks = true, .xforms = true}, dump);
  answers.dump = without(root, dump.str());
  const scene::PhysicsScene scene = physics::read_physics(*stage, {}, diagnostics);
  answers.physics = without(root, answers::scene_json(scene, answers::Geometry::Hash));
  CheckOptions check;
  check.open = open;
  check.profile = "isaac-3.0";
  const auto checked = check_asset(path, check);
  EXPECT_TRUE(checked);
  for (const check::Finding& finding : checked->findings) {
    answers.findings += without(root, told(finding.diagnostic));
  }
  for (const Diagnostic& d : diagnostics) {
    answers.diagnostics += without(root, told(d));
  }
  Diagnostics ignored;
  const auto packed = pack_asset(path, open, ignored);
  answers.package = packed ? packed->package : std::string();
  return answers;
}

void expect_equal(const Answers& a, const Answers& b) {
  EXPECT_EQ(a.dump, b.dump);
  EXPECT_EQ(a.physics, b.physics);
  EXPECT_EQ(a.findings, b.findings);
  EXPECT_EQ(a.diagnostics, b.diagnostics);
  EXPECT_TRUE(a.package == b.package) << a.package.size() << " and " << b.package.size();
}

/// An asset with each kind of name that leads to a file; it has faults that findings name.
std::map<std::string, std::string> everything() {
  const std::string prim = "#usda 1.0\n(\n    defaultPrim = \"P\"\n)\ndef Xform \"P\"\n{\n";
  std::map<std::string, std::string> files;
  files["sub/over.usda"] = prim + "    custom double fromSublayer = 1\n}\n";
  files["sub/cup.usda"] =
      prim +
      "    def Cube \"c\" (\n        prepend apiSchemas = [\"PhysicsCollisionAPI\"]\n    )\n" +
      "    {\n        double size = 0.1\n    }\n}\n";
  files["load.usdc"] = prim + "    custom double fromPayload = 2\n}\n";  // told by its bytes
  files["clips/c.1.usda"] = prim + "    double size.timeSamples = {\n        1: 5,\n    }\n}\n";
  files["clips/c.2.usda"] = prim + "    double size.timeSamples = {\n        2: 7,\n    }\n}\n";
  files["textures/wood.png"] = kPng;
  files["textures/tile.1001.png"] = kPng;
  files["packed.usdz"] = *bytes::write_zip(
      {{"root.usda", prim + "    asset inside = @t/x.png@\n}\n"}, {"t/x.png", kPng}});
  files["lib/found.usda"] = prim + "    custom double fromSearchPath = 3\n}\n";
  files["root.usda"] = R"(#usda 1.0
(
    defaultPrim = "World"
    subLayers = [@./sub/over.usda@]
    metersPerUnit = 1
)
def Xform "World"
{
    def "Cup" (prepend references = @sub/cup.usda@) {}
    def "Loaded" (prepend payload = @./load.usdc@) {}
    def "Packed" (prepend references = @./packed.usdz@) {}
    def "Found" (prepend references = @found.usda@) {}
    def "Missing" (prepend references = @./none.usda@) {}
    def Cube "Clipped" (
        clips = {
            dictionary default = {
                string primPath = "/P"
                asset[] assetPaths = [@./clips/c.1.usda@, @./clips/c.2.usda@]
                double2[] active = [(1, 0), (2, 1)]
                string templateAssetPath = "./clips/c.#.usda"
                double templateStartTime = 1
                double templateEndTime = 2
                double templateStride = 1
            }
        }
    )
    {
    }
    asset image = @textures/wood.png@
    asset tiles = @textures/tile.<UDIM>.png@
    asset nowhere = @textures/none.png@
}
)";
  return files;
}

class AssetInMemory : public testing::Test {
 protected:
  AssetInMemory() {
    std::string name = testing::TempDir() + "/in_memory.XXXXXX";
    folder_ = fs::canonical(::mkdtemp(name.data())).string();
  }
  ~AssetInMemory() override { fs::remove_all(folder_); }

  void put(const std::map<std::string, std::string>& files) const {
    for (const auto& [name, contents] : files) {
      fs::create_directories(fs::path(folder_ + "/" + name).parent_path());
      std::ofstream(folder_ + "/" + name, std::ios::binary) << contents;
    }
  }

  std::string folder_;
};

TEST_F(AssetInMemory, EveryKindOfNameLeadsToTheSameAsOnTheDisk) {
  put(everything());
  OpenOptions disk;
  disk.search_paths = {folder_ + "/lib"};
  OpenOptions memory = reading(in_memory(everything(), "/made-up/of"));
  memory.search_paths = {"/made-up/of/lib"};
  const Answers on_disk = answers_of(folder_, "root.usda", disk);
  const Answers in_it = answers_of("/made-up/of", "root.usda", memory);
  expect_equal(on_disk, in_it);
  for (const char* part :
       {"fromSublayer", "fromPayload", "fromSearchPath", "\"inside\"", "Clipped"}) {
    EXPECT_NE(in_it.dump.find(part), std::string::npos) << part;
  }
  EXPECT_NE(in_it.findings.find("<root>/root.usda:"), std::string::npos) << in_it.findings;
  EXPECT_NE(in_it.diagnostics.find("none.usda"), std::string::npos) << in_it.diagnostics;
  EXPECT_NE(in_it.package.find("wood.png"), std::string::npos);
}

TEST_F(AssetInMemory, TheExampleHandIsTheSameAsOnTheDisk) {
  const std::string hand = TENON_SOURCE_DIR "/examples/inspire_hand";
  const bytes::Files files = in_memory(files_of(hand), "/nowhere/hand");
  expect_equal(answers_of(hand, "inspire_hand.usda", {}),
               answers_of("/nowhere/hand", "inspire_hand.usda", reading(files)));
}

TEST_F(AssetInMemory, AFileOfTheDiskIsNotFoundFromMemory) {
  put(everything());
  const std::string root = contents_of(folder_ + "/root.usda");
  const bytes::Files alone = in_memory({{"root.usda", root}}, folder_);
  bytes::ReadRecord record;
  record.install();
  Diagnostics diagnostics;
  OpenOptions options = reading(alone);
  options.search_paths = {folder_ + "/lib"};
  const auto stage = tenon::open(folder_ + "/root.usda", options, diagnostics);
  ASSERT_TRUE(stage);
  EXPECT_EQ(stage->used_layers().size(), 1u);
  const auto count = [&](const char* name) {
    return std::count_if(diagnostics.begin(), diagnostics.end(), [&](const Diagnostic& d) {
      return d.message.find("cannot find @") != std::string::npos &&
             d.message.find(name) != std::string::npos;
    });
  };
  for (const char* name : {"sub/over.usda", "sub/cup.usda", "load.usdc", "packed.usdz", "found"}) {
    EXPECT_EQ(count(name), 1) << name;
  }
  const stage::Attribute image = stage->prim(Path::from("/World")).attribute("image");
  EXPECT_EQ(image.get_as<layer::AssetPath>()->resolved, "");
  Diagnostics ignored;
  const auto packed = pack_asset(folder_ + "/root.usda", options, ignored);
  ASSERT_TRUE(packed);
  EXPECT_EQ(packed->files.size(), 1u);
  EXPECT_FALSE(open_layer(folder_ + "/sub/cup.usda", options, ignored));
  options.session_path = folder_ + "/sub/over.usda";
  EXPECT_FALSE(tenon::open(folder_ + "/root.usda", options, ignored));
  CheckOptions check;
  check.open = reading(alone);
  EXPECT_TRUE(check_asset(folder_ + "/root.usda", check));
  for (const auto& [name, contents] : everything()) {
    const auto stamp = bytes::stamp_of(folder_ + "/" + name);
    ASSERT_TRUE(stamp) << name;
    EXPECT_FALSE(record.has(stamp->identity)) << name << " was opened";
  }
}

TEST_F(AssetInMemory, UnsavedTextIsCheckedWithItsLines) {
  put(everything());
  const std::string unsaved =
      "#usda 1.0\n(\n    defaultPrim = \"P\"\n)\n\n\n\ndef Xform \"P\"\n{\n"
      "    def \"gone\" (prepend references = @./gone.usda@) {}\n}\n";
  CheckOptions check;
  check.open.files =
      bytes::Files().with({{folder_ + "/sub/cup.usda", bytes::FileBytes::own(unsaved)}});
  const auto lines = [&](const CheckOptions& options) {
    std::string found;
    const auto checked = check_asset(folder_ + "/root.usda", options);
    for (const check::Finding& finding : checked->findings) {
      const Diagnostic& d = finding.diagnostic;
      const bool about = d.message.find("gone.usda") != std::string::npos;
      found += about ? fs::path(d.file).filename().string() + ":" + std::to_string(d.line) + ":" +
                           std::to_string(d.column) + " "
                     : "";
    }
    return found;
  };
  EXPECT_EQ(lines(check), "cup.usda:10:38 ");
  EXPECT_EQ(lines({}), "") << "the disk is as it was";
}

TEST_F(AssetInMemory, FoldersAreSearchedInMemory) {
  const bytes::Files files = in_memory(everything(), "/made-up");
  EXPECT_EQ(*root_assets("/made-up", reading(files)),
            (std::vector<std::string>{"/made-up/lib/found.usda", "/made-up/root.usda"}));
  EXPECT_EQ(*root_assets("/made-up/none", reading(files)),
            std::vector<std::string>{"/made-up/none"});
}

TEST_F(AssetInMemory, IdleLayersInPayloadsBelongToTheAsset) {
  const std::string head = "#usda 1.0\n(\n    defaultPrim = \"P\"\n)\n";
  const std::string root = head + "def \"P\" (prepend references = @./payloads/base.usda@) {}\n";
  const std::string idle = "#usda 1.0\ndef Scope \"Materials\" {}\n";
  const auto roots = [&](std::map<std::string, std::string> files) {
    return *root_assets("/a", reading(in_memory(files, "/a")));
  };
  const std::string base = head + "def Xform \"P\" {}\n";
  EXPECT_EQ(roots({{"arm/arm.usda", root},
                   {"arm/payloads/base.usda", base},
                   {"arm/payloads/materials.usda", idle},
                   {"arm/payloads/Physics/idle.usda", idle},
                   {"arm/other/materials.usda", idle}}),
            (std::vector<std::string>{"/a/arm/arm.usda", "/a/arm/other/materials.usda"}));
  EXPECT_EQ(roots({{"arm/arm.usda", root},
                   {"arm/payloads/base.usda", base},
                   {"arm/payloads/opens.usda", base}}),
            (std::vector<std::string>{"/a/arm/arm.usda", "/a/arm/payloads/opens.usda"}))
      << "a layer with a default prim can be opened, and may be an asset";
  EXPECT_EQ(roots({{"payloads/materials.usda", idle}}),
            std::vector<std::string>{"/a/payloads/materials.usda"})
      << "there is no asset that it could belong to";
}

TEST_F(AssetInMemory, EditsAndStructureReadFromMemory) {
  const std::map<std::string, std::string> hand =
      files_of(TENON_SOURCE_DIR "/examples/inspire_hand");
  const OpenOptions open = reading(in_memory(hand, "/hand"));
  Diagnostics diagnostics;
  const auto made = structure_asset("/hand/inspire_hand.usda", open, {}, diagnostics);
  EXPECT_TRUE(made) << (made ? "" : made.error().diagnostic().message);
  AssetEdit edit;
  edit.object = Path::from("/inspire_hand/r_base_link.physics:mass");
  edit.value = "0.5";
  EditOptions options;
  options.open = open;
  const auto edited = edit_asset("/hand/inspire_hand.usda", {edit}, options, diagnostics);
  ASSERT_TRUE(edited) << edited.error().diagnostic().message;
  ASSERT_EQ(edited->files.size(), 1u);
  const std::string name = "payloads/Physics/physics.usda";
  EXPECT_EQ(edited->files[0].path, "/hand/" + name);
  std::string expected = hand.at(name);
  expected.replace(expected.find("0.398207"), std::string("0.398207").size(), "0.5");
  EXPECT_EQ(edited->files[0].after, expected);
}

TEST_F(AssetInMemory, DescriptionsConvertFromMemoryAndWorkersNeedTheDisk) {
  const std::string stl =
      "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
      "vertex 0 1 0\nendloop\nendfacet\nendsolid s\n";
  const auto robot = [](const std::string& mesh) {
    return "<robot name=\"r\"><link name=\"l\"><visual><geometry><mesh filename=\"" + mesh +
           "\"/></geometry></visual></link></robot>";
  };
  put({{"m.dae", "<COLLADA/>"}, {"m.stl", stl}, {"m.xml", "<mujoco/>"}});  // must not be seen
  ConvertFileOptions options;
  options.open = reading(in_memory({{"a.urdf", robot("a.stl")},
                                    {"a.stl", stl},
                                    {"b.urdf", robot("m.stl")},
                                    {"c.urdf", robot("c.dae")},
                                    {"c.dae", "<COLLADA/>"},
                                    {"d.xml", "<mujoco/>"}},
                                   folder_));
  const auto faults = [&](const char* name) {
    Diagnostics diagnostics;
    EXPECT_TRUE(convert_file(folder_ + name, options, diagnostics));
    std::string found;
    for (const Diagnostic& d : diagnostics) {
      found += d.severity == Severity::Info ? "" : told(d);
    }
    return found;
  };
  EXPECT_EQ(faults("/a.urdf"), "");
  EXPECT_NE(faults("/b.urdf").find("cannot be found"), std::string::npos);
  EXPECT_NE(faults("/c.urdf").find("file.not-on-disk"), std::string::npos);
  Diagnostics diagnostics;
  const auto mjcf = convert_file(folder_ + "/d.xml", options, diagnostics);
  ASSERT_FALSE(mjcf);
  EXPECT_EQ(mjcf.error().diagnostic().rule, "file.not-on-disk");
}

}  // namespace
}  // namespace tenon
