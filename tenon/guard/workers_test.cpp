// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/guard/workers.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tenon/guard/worker_place.h"
#include "tenon/mesh/mesh_scene.h"

namespace tenon::guard {
namespace {

namespace fs = std::filesystem;

/// Malicious workers, as scripts; the socket is their standard input.
class HostileWorker : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("tenon_guard_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override {
    set_worker_program("");
    fs::remove_all(folder_);
  }

  /// The error of a file that is read by this script.
  Error error_of(const std::string& script, const Allowance& allowance = {}) {
    const fs::path program = folder_ / "worker.sh";
    std::ofstream(program) << "#!/bin/sh\n" << script << "\n";
    fs::permissions(program, fs::perms::owner_all);
    set_worker_program(program.string());
    std::ofstream(folder_ / "f.dae") << "<COLLADA/>";
    Workers workers(allowance);
    const auto read = read_guarded<AboutWorker>(
        workers, {Reader::Mesh, (folder_ / "f.dae").string(), {}}, findings_);
    EXPECT_FALSE(read) << script;
    return read ? Error(ErrorCode::Io, "") : read.error();
  }
  static std::string rule_of(const Error& error) { return error.diagnostic().rule; }

  Diagnostics findings_;
  fs::path folder_;
};

TEST_F(HostileWorker, ThatIsKilledIsAnError) {
  const Error at_once = error_of("kill -KILL $$");
  EXPECT_EQ(rule_of(at_once), "guard.crashed");
  EXPECT_EQ(at_once.diagnostic().file, (folder_ / "f.dae").string());
  EXPECT_NE(at_once.message().find("SIGKILL"), std::string::npos) << at_once.message();
  // 256 bytes are announced, three come.
  const Error midway = error_of(R"(printf '\000\001\000\000\000\000\000\000abc' >&0; kill -9 $$)");
  EXPECT_EQ(rule_of(midway), "guard.crashed");
  EXPECT_EQ(rule_of(error_of("kill -SEGV $$")), "guard.crashed");
  EXPECT_EQ(rule_of(error_of("exit 0")), "guard.crashed");
  EXPECT_EQ(rule_of(error_of("exit 3")), "guard.crashed");
}

TEST_F(HostileWorker, ThatTakesTooMuchIsALimit) {
  EXPECT_EQ(rule_of(error_of("kill -XCPU $$")), "guard.time");
  EXPECT_EQ(rule_of(error_of("exit 65")), "guard.memory");
  const Error error = error_of("exit 66");
  EXPECT_EQ(rule_of(error), "guard.reply");
  EXPECT_EQ(error.code(), ErrorCode::Limit);
}

TEST_F(HostileWorker, ThatCannotRunIsNoFaultOfTheFile) {
  const Error error = error_of("exit 127");
  EXPECT_EQ(rule_of(error), "guard.no-worker");
  EXPECT_EQ(error.code(), ErrorCode::Missing);
}

TEST_F(HostileWorker, ThatHangsIsStopped) {
  Allowance allowance;
  allowance.wall_seconds = 1;
  EXPECT_EQ(rule_of(error_of("exec sleep 100", allowance)), "guard.time");
  EXPECT_EQ(rule_of(error_of("trap '' TERM INT HUP; while :; do sleep 1; done", allowance)),
            "guard.time");
}

TEST_F(HostileWorker, ThatAnswersGarbageIsAnError) {
  EXPECT_EQ(rule_of(error_of(R"(printf '\003\000\000\000\000\000\000\000abc' >&0; sleep 9)")),
            "guard.crashed");
  EXPECT_EQ(rule_of(error_of(R"(printf '\000\000\000\000\000\000\000\000' >&0; sleep 9)")),
            "guard.crashed");
  // Neither a value nor a failure: an answer's five fields, all empty.
  EXPECT_EQ(rule_of(error_of(R"({ printf '\032\000\000\000\000\000\000\000'; )"
                             "head -c 26 /dev/zero; } >&0; sleep 9")),
            "guard.crashed");
}

TEST_F(HostileWorker, ThatAnnouncesMoreThanItMayIsStopped) {
  EXPECT_EQ(rule_of(error_of(R"(printf '\377\377\377\377\377\377\377\177' >&0; sleep 9)")),
            "guard.reply");
  Allowance allowance;
  allowance.reply_bytes = 100;
  EXPECT_EQ(
      rule_of(error_of(R"(printf '\000\020\000\000\000\000\000\000' >&0; sleep 9)", allowance)),
      "guard.reply");
}

TEST_F(HostileWorker, LosesNoMoreThanTheCommandMay) {
  error_of("kill -9 $$");  // sets the script
  Workers workers;
  const Request request{Reader::Mesh, (folder_ / "f.dae").string(), {}};
  for (std::size_t i = 0; i < limits::kGuardLosses; ++i) {
    EXPECT_EQ(rule_of(read_guarded<AboutWorker>(workers, request, findings_).error()),
              "guard.crashed");
  }
  const auto further = read_guarded<AboutWorker>(workers, request, findings_);
  ASSERT_FALSE(further);
  EXPECT_EQ(rule_of(further.error()), "guard.losses");
  EXPECT_EQ(workers.started(), limits::kGuardLosses);
}

TEST_F(HostileWorker, SeesNoDescriptorsOfThisProcess) {
  const fs::path seen = folder_ / "seen";
  std::ofstream kept(folder_ / "kept");
  error_of("ls /proc/$$/fd > " + seen.string());
  std::ifstream file(seen);
  for (int descriptor = 0; file >> descriptor;) {
    EXPECT_TRUE(descriptor <= 2 || descriptor >= 10) << descriptor;  // those of the shell are high
  }
}

TEST_F(HostileWorker, ThatIsNotThereIsNamed) {
  set_worker_program((folder_ / "none").string());
  Workers workers;
  const auto read = read_guarded<AboutWorker>(workers, {Reader::Mesh, "x.dae", {}}, findings_);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code(), ErrorCode::Missing);
  EXPECT_EQ(rule_of(read.error()), "guard.no-worker");
  EXPECT_NE(read.error().message().find((folder_ / "none").string()), std::string::npos);
  EXPECT_EQ(read.error().diagnostic().file, "x.dae");
}

/// The real one, beside this test.
TEST(Worker, TellsWhatHoldsIt) {
  Workers workers;
  Diagnostics none;
  const auto about = read_guarded<AboutWorker>(workers, {Reader::About, "", {}}, none);
  ASSERT_TRUE(about) << about.error().to_string();
  EXPECT_TRUE(about->confinement.no_new_privileges);
  // It serves on, in one process.
  EXPECT_TRUE(read_guarded<AboutWorker>(workers, {Reader::About, "", {}}, none));
  EXPECT_EQ(workers.started(), 1u);
  EXPECT_TRUE(none.empty());
}

TEST(Worker, NamesEachFileThatItReads) {
  Workers workers;
  Diagnostics findings;
  if (read_guarded<AboutWorker>(workers, {Reader::About, "", {}}, findings)->assimp.empty()) {
    GTEST_SKIP() << "without assimp";
  }
  const fs::path folder =
      fs::canonical(fs::temp_directory_path()) / ("tenon_guard_opened_" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "numbers.bin") << std::string(36, '\0');
  std::ofstream(folder / "m.gltf")
      << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
             "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
             "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
                           "min":[0,0,0],"max":[0,0,0]}],
             "bufferViews":[{"buffer":0,"byteLength":36}],
             "buffers":[{"byteLength":36,"uri":"numbers.bin"}]})";
  const std::string file = (folder / "m.gltf").string();
  for (int i = 0; i < 2; ++i) {  // the second is by the same process
    std::vector<std::string> opened;
    const Request request{Reader::Mesh, file, {}};
    EXPECT_TRUE(read_guarded<mesh::MeshScene>(workers, request, findings, &opened));
    EXPECT_EQ(opened, (std::vector<std::string>{file, (folder / "numbers.bin").string()}));
  }
  fs::remove_all(folder);
}

TEST(Worker, RefusesMoreFoldersThanAreUsual) {
  Workers workers;
  Diagnostics none;
  const Request request{Reader::About, "", std::vector<std::string>(limits::kGuardRoots + 1, "/")};
  const auto about = read_guarded<AboutWorker>(workers, request, none);
  ASSERT_FALSE(about);
  EXPECT_EQ(about.error().diagnostic().rule, "guard.roots");
}

}  // namespace
}  // namespace tenon::guard
