// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/python/python_program.h"

#include <cerrno>
#include <cstdlib>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tenon::cli {
namespace {

constexpr int kNoPackage = 104;

/// An empty entry of sys.path is the working directory, where anybody may have put a tenon_usd.
constexpr const char* kStart =
    "import sys\n"
    "sys.path[:] = [path for path in sys.path if path]\n"
    "import importlib, importlib.util\n"
    "if importlib.util.find_spec('tenon_usd') is None: sys.exit(104)\n"
    "sys.exit(importlib.import_module(sys.argv[1]).main(sys.argv[2:]))\n";

Error no_python(const std::string& why) {
  return Error(ErrorCode::Missing, "this verb is in tenon's Python package: " + why)
      .with_rule("python.missing")
      .with_fix(
          "install its wheel (make wheel && pip install dist/tenon_usd-*.whl) for the python3 of "
          "the PATH, or for the one that TENON_PYTHON names");
}

/// The exit code of a child; that of a shell for one that a signal ended.
int wait_for(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  constexpr int kSignalled = 128;
  return WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status);
}

}  // namespace

Result<int> run_python_program(const std::string& module,
                               const std::vector<std::string>& arguments) {
  const char* named = std::getenv("TENON_PYTHON");
  std::vector<std::string> words = {named != nullptr && *named != '\0' ? named : "python3", "-c",
                                    kStart, module};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) {
    pointers.push_back(word.data());
  }
  pointers.push_back(nullptr);
  pid_t process = 0;
  if (posix_spawnp(&process, pointers[0], nullptr, nullptr, pointers.data(), environ) != 0) {
    return no_python(words[0] + " cannot be started");
  }
  const int code = wait_for(process);
  if (code == kNoPackage) {
    return no_python(words[0] + " has no package tenon_usd");
  }
  return code;
}

}  // namespace tenon::cli
