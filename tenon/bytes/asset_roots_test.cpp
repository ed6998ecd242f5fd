// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/asset_roots.h"

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tenon/bytes/write/atomic_write.h"

namespace tenon::bytes {
namespace {

namespace fs = std::filesystem;

class AssetRoots : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::canonical(testing::TempDir()) / ("roots_" + std::to_string(::getpid()));
    fs::remove_all(root_);
    for (const char* name : {"pkg/package.xml",
                             "pkg/urdf/deep/r.urdf",
                             "pkg/meshes/m.stl",
                             "hand/hand.usda",
                             "hand/payloads/base.usda",
                             "hand/payloads/Physics/physx.usda",
                             "other/package.xml",
                             "assets/hand/reach.xml",
                             "assets/stls/hand/a.stl",
                             "assets/notes.txt",
                             "lib/two/__init__.py",
                             "lib/two/robots/__init__.py",
                             "lib/two/robots/body/one/r.urdf",
                             "lib/two/robots/hands/left/meshes/h.obj",
                             "lib/two/robots/hands/left/data/d.obj",
                             "lib/others/hands/left/meshes/o.obj",
                             "arms/fingers/meshes/f.obj",
                             "arms/gripper/g.urdf",
                             "private/x/meshes/m.obj",
                             "secret/s.png"}) {
      fs::create_directories((root_ / name).parent_path());
      ASSERT_TRUE(write_file(at(name), name == std::string("pkg/package.xml")
                                           ? "<?xml version=\"1.0\"?>\n<package format=\"2\"/>"
                                           : "x"));
    }
  }
  void TearDown() override { fs::remove_all(root_); }
  std::string at(const std::string& name) const { return (root_ / name).string(); }
  bool has_root(const std::string& asset, const std::string& folder) const {
    const std::vector<std::string> roots = roots_of_asset(Files(), at(asset));
    return std::find(roots.begin(), roots.end(), at(folder)) != roots.end();
  }

  fs::path root_;
};

TEST_F(AssetRoots, AnAssetHasItsFolderAndItsPackage) {
  EXPECT_EQ(roots_of_asset(Files(), at("hand/hand.usda")), std::vector<std::string>{at("hand")});
  EXPECT_TRUE(has_root("hand/payloads/base.usda", "hand"));
  EXPECT_TRUE(has_root("hand/payloads/Physics/physx.usda", "hand"));
  EXPECT_TRUE(has_root("pkg/urdf/deep/r.urdf", "pkg/urdf/deep"));
  EXPECT_TRUE(has_root("pkg/urdf/deep/r.urdf", "pkg"));
  EXPECT_FALSE(is_ros_package(Files(), at("other")));  // its package.xml is none
}

TEST_F(AssetRoots, ALinkToAnAssetHasTheFoldersOfBoth) {
  fs::create_symlink(at("pkg/urdf/deep/r.urdf"), at("hand/link.urdf"));
  EXPECT_TRUE(has_root("hand/link.urdf", "hand"));
  EXPECT_TRUE(has_root("hand/link.urdf", "pkg"));
}

TEST_F(AssetRoots, PartsLieBesideTheDescription) {
  EXPECT_EQ(parts_folder(Files(), at("pkg/urdf/deep/r.urdf"), at("pkg/meshes/m.stl")),
            at("pkg/meshes"));
  EXPECT_EQ(
      parts_folder(Files(), at("assets/hand/reach.xml"), at("assets/hand/../stls/hand/a.stl")),
      at("assets/stls"));
  EXPECT_EQ(parts_folder(Files(), at("arms/gripper/g.urdf"), at("arms/fingers/meshes/f.obj")),
            at("arms/fingers/meshes"));
}

TEST_F(AssetRoots, APythonPackageSharesItsFoldersOfParts) {
  const std::string robot = at("lib/two/robots/body/one/r.urdf");
  EXPECT_EQ(parts_folder(Files(), robot, at("lib/two/robots/hands/left/meshes/h.obj")),
            at("lib/two/robots/hands/left/meshes"));
  EXPECT_EQ(parts_folder(Files(), robot, at("lib/two/robots/hands/left/data/d.obj")), std::nullopt);
  EXPECT_EQ(parts_folder(Files(), robot, at("lib/others/hands/left/meshes/o.obj")), std::nullopt);
  fs::remove(at("lib/two/robots/__init__.py"));  // the chain begins at the nearest
  fs::remove(at("lib/two/__init__.py"));
  EXPECT_EQ(parts_folder(Files(), robot, at("lib/two/robots/hands/left/meshes/h.obj")),
            std::nullopt);
}

TEST_F(AssetRoots, WhatIsNoPartOfARobotIsNot) {
  EXPECT_EQ(parts_folder(Files(), at("pkg/urdf/deep/r.urdf"), at("secret/s.png")), std::nullopt);
  EXPECT_EQ(parts_folder(Files(), at("arms/gripper/g.urdf"),
                         at("arms/gripper/../../private/x/meshes/m.obj")),
            std::nullopt);  // too far down
  fs::create_directories(at("hand/meshes"));
  fs::create_symlink(at("secret/s.png"), at("hand/meshes/s.png"));
  EXPECT_EQ(parts_folder(Files(), at("pkg/urdf/deep/r.urdf"), at("hand/meshes/s.png")),
            std::nullopt);
  EXPECT_EQ(parts_folder(Files(), "/x.urdf", "/etc/passwd"), std::nullopt);
}

}  // namespace
}  // namespace tenon::bytes
