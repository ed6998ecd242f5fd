// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/mutants/run_program.h"

#include <cerrno>
#include <cmath>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tenon::fuzz {
namespace {

constexpr rlim_t kLargestOutput = 1u << 30;

void set_limit(int which, rlim_t most) {
  const rlimit limit{most, most};
  setrlimit(static_cast<__rlimit_resource>(which), &limit);
}

void redirect(const std::string& file, int target) {
  const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(opened, target);
}

[[noreturn]] void become(const ProgramCall& call, const ProgramLimits& limits) {
  std::vector<char*> words;
  for (const std::string& word : call.words) {
    words.push_back(const_cast<char*>(word.c_str()));
  }
  words.push_back(nullptr);
  std::vector<char*> environment;
  for (const std::string& entry : call.environment) {
    environment.push_back(const_cast<char*>(entry.c_str()));
  }
  environment.push_back(nullptr);
  const int empty = open("/dev/null", O_RDONLY);
  dup2(empty, STDIN_FILENO);
  redirect(call.out, STDOUT_FILENO);
  redirect(call.err, STDERR_FILENO);
  set_limit(RLIMIT_CORE, 0);
  set_limit(RLIMIT_FSIZE, kLargestOutput);
  const auto seconds = static_cast<rlim_t>(std::ceil(limits.seconds));
  const rlimit processor{seconds, seconds + 1};
  setrlimit(RLIMIT_CPU, &processor);
  if (limits.address_space != 0) {
    set_limit(RLIMIT_AS, limits.address_space);
  }
  alarm(static_cast<unsigned>(seconds * 6));
  if (chdir(call.folder.c_str()) == 0) {
    execve(words[0], words.data(), environment.data());
  }
  _exit(127);
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

}  // namespace

ProgramRun run_program(const ProgramCall& call, const ProgramLimits& limits) {
  const pid_t child = fork();
  if (child == 0) {
    become(call, limits);
  }
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  ProgramRun run;
  run.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  run.exit = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  run.seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  run.peak_bytes = static_cast<std::size_t>(usage.ru_maxrss) * 1024;
  return run;
}

}  // namespace tenon::fuzz
