// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/write/temporary_folder.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace tenon::bytes {
namespace {

namespace fs = std::filesystem;

TEST(TemporaryFolder, IsRemovedWithAllThatIsInIt) {
  std::string path;
  {
    auto folder = TemporaryFolder::make();
    ASSERT_TRUE(folder) << folder.error().to_string();
    path = folder->path();
    EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_all);
    fs::create_directories(fs::path(path) / "a/b");
    std::ofstream(fs::path(path) / "a/b/c") << "text";
    const TemporaryFolder moved = *std::move(folder);
    EXPECT_TRUE(fs::exists(path));
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST(TemporaryFolder, ThatCannotBeMadeIsAnError) {
  const std::string before = std::getenv("TMPDIR") == nullptr ? "" : std::getenv("TMPDIR");
  setenv("TMPDIR", "/no/such/folder", 1);
  const auto folder = TemporaryFolder::make();
  before.empty() ? unsetenv("TMPDIR") : setenv("TMPDIR", before.c_str(), 1);
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().code(), ErrorCode::Io);
}

}  // namespace
}  // namespace tenon::bytes
