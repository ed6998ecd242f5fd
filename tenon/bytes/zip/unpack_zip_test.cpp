// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/zip/unpack_zip.h"

#include <csignal>
#include <filesystem>
#include <iterator>
#include <optional>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tenon/bytes/file_bytes.h"
#include "tenon/bytes/write/killed_child.h"

namespace tenon::bytes {
namespace {

namespace fs = std::filesystem;

ZipArchive archive_of(const std::vector<ZipFile>& files) {
  return *ZipArchive::open(FileBytes::own(*write_zip(files)));
}

class UnpackZip : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(testing::TempDir()) / ("unpack_" + std::to_string(::getpid()));
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  void TearDown() override { fs::remove_all(root_); }
  std::size_t files_in_root() const {
    std::size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(root_)) {
      count += entry.is_regular_file() ? 1 : 0;
    }
    return count;
  }
  fs::path root_;
};

TEST_F(UnpackZip, WritesFilesInFolders) {
  const std::string folder = (root_ / "out").string();
  ASSERT_TRUE(unpack_zip(archive_of({{"a.usda", "A"}, {"b/c/d.png", "D"}}), folder));
  EXPECT_EQ((*FileBytes::open(folder + "/b/c/d.png"))->text(), "D");
  EXPECT_EQ((*FileBytes::open(folder + "/a.usda"))->text(), "A");
  EXPECT_EQ(files_in_root(), 2u);
}

TEST_F(UnpackZip, NoNameLeavesTheFolder) {
  for (const char* name :
       {"../x", "a/../../x", "/etc/x", "a//x", "./x", "a/.", "..", "a\\..\\x", "C:x", "a/b\nx"}) {
    const auto done =
        unpack_zip(archive_of({{"ok.usda", "A"}, {name, "B"}}), (root_ / "out").string());
    ASSERT_FALSE(done) << name;
    EXPECT_EQ(done.error().diagnostic().rule, "package.bad-name") << name;
    EXPECT_EQ(files_in_root(), 0u) << name;
  }
}

TEST_F(UnpackZip, ARequestToEndLeavesTheFolderOrNothing) {
  const ZipArchive archive = archive_of({{"a.usda", "A"}, {"b/c/d.png", "D"}, {"e.usda", "E"}});
  std::size_t without = 0;
  for (int call = 1;; ++call) {
    fs::remove_all(root_);
    fs::create_directories(root_);
    const std::string folder = (root_ / "out").string();
    const std::optional<bool> ended =
        killed_at(call, [&] { return unpack_zip(archive, folder).has_value(); }, SIGTERM);
    if (!ended) {
      GTEST_SKIP() << "processes may not be traced here";
    }
    const auto entries = std::distance(fs::directory_iterator(root_), fs::directory_iterator());
    ASSERT_EQ(entries, fs::exists(folder) ? 1 : 0) << "at call " << call;
    ASSERT_EQ(files_in_root(), fs::exists(folder) ? 3u : 0u) << "at call " << call;
    without += fs::exists(folder) ? 0 : 1;
    if (!*ended) {
      break;
    }
    ASSERT_LT(call, 5000);
  }
  EXPECT_GT(without, 10u);
}

TEST_F(UnpackZip, AFileIsNoFolder) {
  EXPECT_FALSE(unpack_zip(archive_of({{"a", "A"}, {"a/b", "B"}}), (root_ / "out").string()));
  EXPECT_EQ(files_in_root(), 0u);
}

TEST_F(UnpackZip, WhatIsThereStays) {
  const std::string folder = (root_ / "out").string();
  ASSERT_TRUE(unpack_zip(archive_of({{"a", "old"}}), folder));
  EXPECT_FALSE(unpack_zip(archive_of({{"a", "new"}}), folder));
  EXPECT_EQ((*FileBytes::open(folder + "/a"))->text(), "old");
  fs::create_directories(root_ / "empty");
  EXPECT_TRUE(unpack_zip(archive_of({{"a", "new"}}), (root_ / "empty").string()));
}

}  // namespace
}  // namespace tenon::bytes
