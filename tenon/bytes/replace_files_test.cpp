// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/replace_files.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tenon/bytes/killed_child.h"

namespace tenon::bytes {
namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;

const Files kOld{{"hand.usda", "old"},
                 {"payloads/base.usda", "base"},
                 {"payloads/Physics/physics.usda", "old physics"},
                 {"payloads/Physics/physx.usda", "old physx"}};
const Files kChanges{{"payloads/Physics/physics.usda", "new physics"},
                     {"payloads/Physics/physx.usda", std::string(100000, 'x')}};

class ReplaceFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "tenon_replace_XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    root_ = pattern;
    put(kOld);
  }
  void TearDown() override { fs::remove_all(root_); }

  std::string at(const std::string& name) const { return root_ + "/" + name; }

  void put(const Files& files) const {
    for (const auto& [name, contents] : files) {
      fs::create_directories(fs::path(at(name)).parent_path());
      std::ofstream(at(name), std::ios::binary) << contents;
    }
  }

  /// What other programs look at: all but hidden folders, which a kill may leave.
  Files read() const {
    Files files;
    for (fs::recursive_directory_iterator entry(root_), end; entry != end; ++entry) {
      if (entry->path().filename().string().starts_with(".tenon-")) {
        entry.disable_recursion_pending();
      } else if (entry->is_regular_file()) {
        std::ifstream stream(entry->path(), std::ios::binary);
        files[entry->path().lexically_relative(root_).generic_string()] =
            std::string(std::istreambuf_iterator<char>(stream), {});
      }
    }
    return files;
  }

  Result<void> replace(const Files& changes) const {
    Files by_path;
    for (const auto& [name, contents] : changes) {
      by_path.emplace(at(name), contents);
    }
    return replace_files(by_path);
  }

  std::string root_;
};

Files changed(Files files, const Files& changes) {
  for (const auto& [name, contents] : changes) {
    files[name] = contents;
  }
  return files;
}

TEST_F(ReplaceFiles, ChangesThoseFilesAndNoOthers) {
  fs::create_symlink("../../hand.usda", at("payloads/Physics/link.usda"));
  ::chmod(at("payloads/Physics/physx.usda").c_str(), 0640);
  ::chmod(at("payloads/Physics").c_str(), 0750);
  const Files before = read();
  ASSERT_TRUE(replace(kChanges).has_value());
  EXPECT_EQ(read(), changed(before, kChanges));
  EXPECT_EQ(fs::read_symlink(at("payloads/Physics/link.usda")), "../../hand.usda");
  EXPECT_EQ(static_cast<unsigned>(fs::status(at("payloads/Physics/physx.usda")).permissions()),
            0640u);
  EXPECT_EQ(static_cast<unsigned>(fs::status(at("payloads/Physics")).permissions()), 0750u);
  EXPECT_EQ(std::distance(fs::directory_iterator(at("payloads")), fs::directory_iterator()), 2);
}

TEST_F(ReplaceFiles, AFileThatIsNotThereLeavesTheOthers) {
  Files more = kChanges;
  more["payloads/none.usda"] = "new";
  EXPECT_FALSE(replace(more).has_value());
  EXPECT_EQ(read(), kOld);
}

TEST_F(ReplaceFiles, FollowsLinksToFilesElsewhere) {
  fs::create_directory(at("elsewhere"));
  fs::rename(at("payloads/base.usda"), at("elsewhere/base.usda"));
  fs::create_symlink("../elsewhere/base.usda", at("payloads/base.usda"));
  ASSERT_TRUE(replace({{"payloads/base.usda", "new"}, {"hand.usda", "new"}}).has_value());
  EXPECT_TRUE(fs::is_symlink(at("payloads/base.usda")));
  EXPECT_EQ(read().at("elsewhere/base.usda"), "new");
  EXPECT_EQ(read().at("hand.usda"), "new");
}

TEST_F(ReplaceFiles, AKillAtAnySystemCallLeavesTheOldOrTheNew) {
  int old_ones = 0;
  int new_ones = 0;
  const Files wanted = changed(kOld, kChanges);
  for (int call = 1;; ++call) {
    fs::remove_all(root_);
    put(kOld);
    const std::optional<bool> killed =
        killed_at(call, [&] { return replace(kChanges).has_value(); });
    if (!killed) {
      GTEST_SKIP() << "processes may not be traced here";
    }
    const Files after = read();
    ASSERT_TRUE(after == kOld || after == wanted) << "killed at call " << call;
    ++(after == wanted ? new_ones : old_ones);
    if (!*killed) {
      EXPECT_EQ(after, wanted);
      break;
    }
    ASSERT_LT(call, 5000);
  }
  EXPECT_GT(old_ones, 20);
  EXPECT_GT(new_ones, 2);
}

}  // namespace
}  // namespace tenon::bytes
