// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tenon/bytes/read_record.h"
#include "tenon/bytes/write/folder_lock.h"
#include "tenon/bytes/write/killed_child.h"
#include "tenon/structure/package.h"

namespace tenon::structure {
namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;

class WriteFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "tenon_write_XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    parent_ = pattern;
    folder_ = pattern + "/hand";
  }
  void TearDown() override { fs::remove_all(parent_); }

  Files read() const {
    Files files;
    if (!fs::exists(folder_)) {
      return files;
    }
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      if (entry.is_regular_file() && !entry.path().filename().string().starts_with(".tenon")) {
        std::ifstream stream(entry.path(), std::ios::binary);
        files[entry.path().lexically_relative(folder_).generic_string()] =
            std::string(std::istreambuf_iterator<char>(stream), {});
      }
    }
    return files;
  }

  void put(const Files& files) const {
    for (const auto& [name, contents] : files) {
      const fs::path path = fs::path(folder_) / name;
      fs::create_directories(path.parent_path());
      std::ofstream(path, std::ios::binary) << contents;
    }
  }

  /// Until nobody is at work in the folder any more.
  void wait() const {
    std::set<std::string> folders{parent_, folder_};
    for (const auto& entry : fs::recursive_directory_iterator(parent_)) {
      if (entry.is_directory()) {
        folders.insert(entry.path().string());
      }
    }
    ASSERT_TRUE(bytes::FolderLock::take(folders).has_value());
  }

  std::string parent_;
  std::string folder_;
};

/// write_folder of files at hand.
Result<void> write(const Files& files, const std::string& folder, bool force = false) {
  return write_folder({files.begin(), files.end()}, folder, {.force = force});
}

const Files kOld{{"hand.usda", "old"}, {"payloads/base.usda", "old base"}};
const Files kNew{{"hand.usda", "new"},
                 {"payloads/base.usda", "new base"},
                 {"payloads/Physics/physics.usda", std::string(10000, 'p')}};

TEST_F(WriteFolder, ReplacesTheWholeFolder) {
  ASSERT_TRUE(write(kOld, folder_).has_value());
  EXPECT_EQ(read(), kOld);
  ASSERT_TRUE(write(kNew, folder_ + "/", true).has_value());
  EXPECT_EQ(read(), kNew);
  ASSERT_TRUE(write(kOld, folder_, true).has_value());
  EXPECT_EQ(read(), kOld);
  EXPECT_EQ(std::distance(fs::directory_iterator(parent_), fs::directory_iterator()), 1);
}

TEST_F(WriteFolder, RefusesAFolderWithFilesOfSomebodyElse) {
  ASSERT_TRUE(write(kOld, folder_).has_value());
  std::ofstream(folder_ + "/thesis.txt") << "years of work";
  const auto written = write(kNew, folder_);
  ASSERT_FALSE(written.has_value());
  EXPECT_EQ(written.error().code(), ErrorCode::Invalid);
  EXPECT_NE(written.error().message().find("thesis.txt"), std::string::npos);
  EXPECT_EQ(read().size(), 3u);
  ASSERT_TRUE(write(kNew, folder_, true).has_value());
  Files wanted = kNew;
  wanted["thesis.txt"] = "years of work";
  EXPECT_EQ(read(), wanted);
}

TEST_F(WriteFolder, AFolderThatIsThereStaysTheSame) {
  fs::create_directory(folder_);
  const auto before = bytes::stamp_of(folder_);
  ASSERT_TRUE(write(kNew, folder_).has_value());
  EXPECT_EQ(bytes::stamp_of(folder_)->identity, before->identity);
  EXPECT_EQ(read(), kNew);
}

TEST_F(WriteFolder, RefusesNamesThatLeadElsewhere) {
  for (const char* name : {"../x.usda", "/x.usda", "a/../../x", "", "a/"}) {
    EXPECT_FALSE(write({{name, "x"}}, folder_).has_value()) << name;
  }
  EXPECT_FALSE(fs::exists(folder_));
}

TEST_F(WriteFolder, AKillAtAnySystemCallLeavesTheOldOrTheNew) {
  int old_ones = 0;
  int new_ones = 0;
  for (const Files& before : {Files(), kOld}) {
    for (int call = 1;; ++call) {
      fs::remove_all(parent_);
      fs::create_directory(parent_);
      put(before);
      const std::optional<bool> killed =
          bytes::killed_at(call, [&] { return write(kNew, folder_, true).has_value(); });
      if (!killed) {
        GTEST_SKIP() << "processes may not be traced here";
      }
      wait();
      const Files after = read();
      ASSERT_TRUE(after == before || after == kNew) << "killed at call " << call;
      ++(after == kNew ? new_ones : old_ones);
      if (!*killed) {
        EXPECT_EQ(after, kNew);
        break;
      }
      ASSERT_LT(call, 5000);
    }
  }
  EXPECT_GT(old_ones, 20);
  EXPECT_GT(new_ones, 2);
}

}  // namespace
}  // namespace tenon::structure
