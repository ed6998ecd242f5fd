// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/write/atomic_write.h"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tenon::bytes {
namespace {

namespace fs = std::filesystem;

class AtomicWrite : public testing::Test {
 protected:
  AtomicWrite() {
    std::string name = testing::TempDir() + "/atomic.XXXXXX";
    folder_ = fs::canonical(::mkdtemp(name.data())).string();
  }
  ~AtomicWrite() override { fs::remove_all(folder_); }

  std::string in(const std::string& name) const { return folder_ + "/" + name; }
  void put(const std::string& name, const std::string& contents) const {
    std::ofstream(in(name), std::ios::binary) << contents;
  }
  std::string contents(const std::string& name) const {
    std::ifstream file(in(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::size_t file_count() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  std::string folder_;
};

TEST_F(AtomicWrite, MakesAndReplaces) {
  ASSERT_TRUE(write_file(in("a"), "one"));
  ASSERT_TRUE(write_file(in("a"), "two"));
  EXPECT_EQ(contents("a"), "two");
  EXPECT_EQ(file_count(), 1u);
  const mode_t mask = ::umask(0);
  ::umask(mask);
  struct stat info = {};
  ASSERT_EQ(::stat(in("a").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777u, 0666u & ~mask) << "permissions of any new file";
}

TEST_F(AtomicWrite, KeepsPermissions) {
  put("a", "one");
  ASSERT_EQ(::chmod(in("a").c_str(), 0640), 0);
  ASSERT_TRUE(write_file(in("a"), "two"));
  struct stat info = {};
  ASSERT_EQ(::stat(in("a").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 07777u, 0640u);
}

TEST_F(AtomicWrite, FollowsLinksAlsoToFilesThatAreNotThere) {
  fs::create_symlink("b", in("a"));
  fs::create_symlink(in("c"), in("b"));
  ASSERT_TRUE(write_file(in("a"), "one"));
  EXPECT_TRUE(fs::is_symlink(in("a")));
  EXPECT_TRUE(fs::is_symlink(in("b")));
  EXPECT_EQ(contents("c"), "one");
}

TEST_F(AtomicWrite, RefusesReadOnlyFilesAndFolders) {
  put("a", "one");
  ASSERT_EQ(::chmod(in("a").c_str(), 0444), 0);
  const auto refused = write_file(in("a"), "two");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message().find("read-only"), std::string::npos);
  EXPECT_EQ(contents("a"), "one");
  EXPECT_NE(write_file(folder_, "x").error().message().find("folder"), std::string::npos);
  EXPECT_EQ(write_file(in("no/a"), "x").error().code(), ErrorCode::Io);
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(AtomicWrite, WritesToDevicesWithoutReplacingThem) {
  ASSERT_TRUE(write_file("/dev/null", "x"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

/// Runs `work` in a process of its own; its exit status.
template <class Work>
int in_child(Work work) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::_exit(work());
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST_F(AtomicWrite, AFullDiskLeavesTheOldFile) {
  put("a", "one");
  const int status = in_child([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const auto written = write_file(in("a"), std::string(100'000, 'x'));
    return !written && written.error().code() == ErrorCode::Io ? 0 : 1;
  });
  EXPECT_EQ(status, 0);
  EXPECT_EQ(contents("a"), "one");
  EXPECT_EQ(file_count(), 1u) << "nothing else is left";
}

TEST_F(AtomicWrite, AKilledProcessLeavesAWholeFile) {
  const std::string old(3'000'000, 'a');
  const std::string other(3'000'000, 'b');
  put("f", old);
  for (int round = 0; round < 20; ++round) {
    const pid_t child = ::fork();
    if (child == 0) {
      for (int i = 0;; ++i) {
        static_cast<void>(write_file(in("f"), i % 2 == 0 ? other : old));
      }
    }
    ::usleep(static_cast<useconds_t>(500 + 1700 * round));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const std::string found = contents("f");
    ASSERT_TRUE(found == old || found == other) << round;
  }
}

}  // namespace
}  // namespace tenon::bytes
