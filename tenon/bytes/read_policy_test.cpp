// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/read_policy.h"

#include <filesystem>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tenon/bytes/write/atomic_write.h"
#include "tenon/bytes/zip/zip_archive.h"

namespace tenon::bytes {
namespace {

namespace fs = std::filesystem;

class Policy : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::canonical(testing::TempDir()) / ("policy_" + std::to_string(::getpid()));
    fs::remove_all(root_);
    fs::create_directories(root_ / "in/below");
    fs::create_directories(root_ / "inside");
    for (const char* name : {"in/a", "in/below/b", "inside/c", "out"}) {
      ASSERT_TRUE(write_file(at(name), name));
    }
  }
  void TearDown() override { fs::remove_all(root_); }
  std::string at(const std::string& name) const { return (root_ / name).string(); }

  fs::path root_;
};

TEST_F(Policy, ReadsWhatLiesBelowItsFolders) {
  const ReadPolicy policy({at("in")});
  EXPECT_EQ((*policy.open(at("in/a")))->text(), "in/a");
  EXPECT_TRUE(policy.open(at("in/below/b")));
  for (const char* name : {"out", "inside/c", "in/../out", "in/below/../../out", "../x"}) {
    const auto opened = policy.open(at(name));
    ASSERT_FALSE(opened) << name;
    EXPECT_EQ(opened.error().diagnostic().rule, kOutsideRule) << name;
    EXPECT_FALSE(opened.error().diagnostic().fix.empty());
  }
}

TEST_F(Policy, AllowsNothingByDefaultAndEverythingWhereAsked) {
  EXPECT_FALSE(ReadPolicy().open(at("in/a")));
  EXPECT_TRUE(ReadPolicy::unrestricted().open(at("out")));
  EXPECT_TRUE(ReadPolicy({at("none")}).roots().empty());
}

TEST_F(Policy, AFileMayBeNamedAlone) {
  const ReadPolicy policy({at("in/a")});
  EXPECT_TRUE(policy.allows(at("in/a")));
  EXPECT_FALSE(policy.allows(at("in/below/b")));
}

TEST_F(Policy, LinksAreJudgedByWhereTheyLead) {
  fs::create_symlink(at("out"), at("in/link"));
  fs::create_directory_symlink(root_, at("in/up"));
  fs::create_directory_symlink(at("in"), at("way"));
  const ReadPolicy policy({at("in")});
  EXPECT_FALSE(policy.open(at("in/link")));
  EXPECT_FALSE(policy.open(at("in/up/out")));
  EXPECT_TRUE(policy.open(at("way/a")));
  EXPECT_TRUE(ReadPolicy({at("way")}).open(at("in/a")));
  EXPECT_NE(policy.check(at("in/link")).error().message().find(at("out")), std::string::npos);
}

TEST_F(Policy, FilesInPackagesAreJudgedByThePackage) {
  ASSERT_TRUE(write_file(at("in/p.usdz"), *write_zip({{"t", "T"}})));
  fs::copy_file(at("in/p.usdz"), at("p.usdz"));
  const ReadPolicy policy({at("in")});
  EXPECT_EQ((*policy.open(at("in/p.usdz[t]")))->text(), "T");
  EXPECT_FALSE(policy.open(at("p.usdz[t]")));
}

TEST_F(Policy, PipesAndDevicesAreNoFiles) {
  ASSERT_EQ(::mkfifo(at("in/pipe").c_str(), 0600), 0);
  EXPECT_FALSE(ReadPolicy({at("in")}).open(at("in/pipe")));
  EXPECT_FALSE(ReadPolicy::unrestricted().open("/dev/zero"));
  EXPECT_FALSE(ReadPolicy::unrestricted().open(at("in")));
}

TEST_F(Policy, AFileThatClaimsMoreThanTheLimitIsNotRead) {
  fs::resize_file(at("in/a"), std::uintmax_t{1} << 33);  // takes no room
  const auto opened = ReadPolicy({at("in")}).open(at("in/a"));
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code(), ErrorCode::Limit);
}

}  // namespace
}  // namespace tenon::bytes
