// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/guard/driven_program.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>
#include <unistd.h>

namespace tenon::guard {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

constexpr std::size_t kLongest = 1u << 20;

class DrivenProgramTest : public testing::Test {
 protected:
  DrivenProgramTest()
      : folder_(fs::temp_directory_path() / ("tenon_driven_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~DrivenProgramTest() override { fs::remove_all(folder_); }

  /// The shell with a script.
  static std::unique_ptr<DrivenProgram> shell(const std::string& script,
                                              std::size_t longest = kLongest) {
    auto driven = DrivenProgram::start(
        "/bin/sh", {{"-c", script}, {"TENON_PLANTED=seen", "HOME=/planted"}, longest});
    EXPECT_TRUE(driven) << driven.error().to_string();
    return driven ? *std::move(driven) : nullptr;
  }
  static bool is_alive(int process) {
    std::ifstream status("/proc/" + std::to_string(process) + "/stat");
    std::string word;
    status >> word >> word >> word;
    return !word.empty() && word != "Z";
  }
  /// The number in a file that a script writes.
  int number_in(const fs::path& file) const {
    int number = 0;
    for (int i = 0; i < 500 && number == 0; ++i) {
      std::ifstream(folder_ / file) >> number;
      std::this_thread::sleep_for(milliseconds(10));
    }
    return number;
  }

  fs::path folder_;
};

TEST_F(DrivenProgramTest, AnswersMessages) {
  const auto driven = shell("exec cat <&3 >&4");
  std::string message;
  driven->post("one");
  driven->post("two");
  ASSERT_EQ(driven->receive(message, milliseconds(10'000)), Waiting::Done);
  EXPECT_EQ(message, "one");
  ASSERT_EQ(driven->receive(message, milliseconds(10'000)), Waiting::Done);
  EXPECT_EQ(message, "two");
  EXPECT_EQ(driven->receive(message, milliseconds(1)), Waiting::Late);
}

TEST_F(DrivenProgramTest, WithMuchToSayDoesNotBlock) {
  const auto driven = shell("exec cat <&3 >&4", 64u << 20);
  const std::string large(20u << 20, 'x');  // far more than sockets hold
  driven->post(large);
  std::string message;
  ASSERT_EQ(driven->receive(message, milliseconds(60'000)), Waiting::Done);
  EXPECT_EQ(message, large);
}

TEST_F(DrivenProgramTest, ThatEndsIsSeenAndItsWordsAreKept) {
  const auto driven = shell("printf 'last\\0' >&4; echo no use >&2; exit 3");
  std::string message;
  EXPECT_EQ(driven->receive(message, milliseconds(10'000)), Waiting::Done);
  EXPECT_EQ(driven->receive(message, milliseconds(10'000)), Waiting::Ended);
  driven->end();
  EXPECT_EQ(driven->last_words(), "no use\n");
  EXPECT_EQ(driven->receive(message, milliseconds(10)), Waiting::Ended);
}

TEST_F(DrivenProgramTest, WhoseWordsHaveNoEndIsHeardInPart) {
  const auto driven = shell("yes word | head -c 1000000 >&2; printf 'done\\0' >&4");
  std::string message;
  EXPECT_EQ(driven->receive(message, milliseconds(60'000)), Waiting::Done);
  EXPECT_LE(driven->last_words().size(), 80'000u);
}

TEST_F(DrivenProgramTest, MayNotSayTooMuchAtOnce) {
  const auto driven = shell("yes | head -c 3000000 >&4", 1000);
  std::string message;
  EXPECT_EQ(driven->receive(message, milliseconds(60'000)), Waiting::TooLong);
}

TEST_F(DrivenProgramTest, IsKilledWithWhatItHasStarted) {
  const std::string pid = (folder_ / "pid").string();
  const auto driven =
      shell("trap '' TERM; sh -c 'echo $$ > " + pid + "; while :; do sleep 1; done' & sleep 100");
  const int child = number_in("pid");
  ASSERT_GT(child, 0);
  EXPECT_TRUE(is_alive(child));
  driven->end();
  EXPECT_FALSE(is_alive(child));
}

TEST_F(DrivenProgramTest, GetsNoOtherDescriptors) {
  std::ofstream kept(folder_ / "kept");
  const fs::path seen = folder_ / "seen";
  const auto driven = shell("ls /proc/$$/fd > " + seen.string() + "; printf '\\0' >&4");
  std::string message;
  ASSERT_EQ(driven->receive(message, milliseconds(10'000)), Waiting::Done);
  std::ifstream file(seen);
  for (int descriptor = 0; file >> descriptor;) {
    EXPECT_TRUE(descriptor <= 4 || descriptor >= 10) << descriptor;  // those of the shell are high
  }
}

TEST_F(DrivenProgramTest, HasTheEnvironmentWithSomeOfItReplaced) {
  const auto driven = shell("printf '%s %s %s\\0' $TENON_PLANTED $HOME \"$PATH\" >&4");
  std::string message;
  ASSERT_EQ(driven->receive(message, milliseconds(10'000)), Waiting::Done);
  EXPECT_EQ(message, "seen /planted " + std::string(std::getenv("PATH")));
}

TEST_F(DrivenProgramTest, ThatIsNotThereIsMissing) {
  const auto driven = DrivenProgram::start((folder_ / "none").string(), {});
  ASSERT_FALSE(driven);
  EXPECT_EQ(driven.error().code(), ErrorCode::Missing);
  EXPECT_EQ(driven.error().diagnostic().file, (folder_ / "none").string());
}

TEST_F(DrivenProgramTest, IsFoundByItsNameAsShellsDo) {
  EXPECT_EQ(find_program({(folder_ / "none").string(), "/bin/sh"}), "/bin/sh");
  const auto shell_found = find_program({"no-such-program-here", "sh"});
  ASSERT_TRUE(shell_found);
  EXPECT_TRUE(shell_found->ends_with("/sh"));
  std::ofstream(folder_ / "not-to-run") << "text";
  EXPECT_FALSE(find_program({(folder_ / "not-to-run").string()}));
  EXPECT_FALSE(find_program({folder_.string()}));
  EXPECT_FALSE(find_program({""}));
}

}  // namespace
}  // namespace tenon::guard
