// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// tenon-worker as the beginning of another program: it confines itself and becomes that. What the
// program reads is bounded by the kernel's Landlock alone, since no function of this process is in
// it; so without Landlock nothing is run.
//
//     tenon-worker run MEMORY SECONDS r:FOLDER x:FOLDER ... -- PROGRAM ARGUMENTS
//
// r: may be read, x: programs in it may be started, too. Descriptors 3 and 4 stay open.
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "tenon/guard/messages.h"
#include "worker/confine.h"

namespace tenon::worker {
namespace {

void bound(__rlimit_resource which, rlim_t most) {
  const rlimit limit{most, most};
  setrlimit(which, &limit);
}

[[noreturn]] void refuse(guard::WorkerExit how, std::string_view words) {
  static_cast<void>(write(STDERR_FILENO, words.data(), words.size()) < 0);
  _exit(static_cast<int>(how));
}

}  // namespace

void run_confined(int count, char** words) {
  std::vector<std::string> readable;
  std::vector<std::string> runnable;
  int at = 2;
  for (; at < count && std::strcmp(words[at], "--") != 0; ++at) {
    const std::string word = words[at];
    (word.starts_with("x:") ? runnable : readable).push_back(word.substr(2));
  }
  if (at + 1 >= count) {
    refuse(guard::WorkerExit::BadTask, "tenon-worker: no program\n");
  }
  bound(RLIMIT_CORE, 0);
  bound(RLIMIT_FSIZE, 0);
  bound(RLIMIT_NOFILE, limits::kGuardOpenFiles);
  bound(RLIMIT_AS, std::strtoull(words[0], nullptr, 10));
  bound(RLIMIT_CPU, std::strtoull(words[1], nullptr, 10));
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 || restrict_files(readable, runnable) == 0) {
    refuse(guard::WorkerExit::NoSandbox, "tenon-worker: no sandbox\n");
  }
  drop_capabilities();
  if (!restrict_program_calls()) {
    refuse(guard::WorkerExit::NoSandbox, "tenon-worker: no sandbox\n");
  }
  execv(words[at + 1], words + at + 1);
  refuse(guard::WorkerExit::NoProgram, "tenon-worker: the program cannot be started\n");
}

}  // namespace tenon::worker
