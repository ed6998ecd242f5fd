// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>
#include <functional>
#include <optional>

#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

/// For tests of what a kill leaves behind.
namespace tenon::bytes {

/// Runs `deed` in a child that gets a signal as it enters its system call number `call`, from 1,
/// and waits until it has ended. False once the child ends before that; nothing where processes may
/// not be traced or the deed fails.
inline std::optional<bool> killed_at(int call, const std::function<bool()>& deed,
                                     int signal = SIGKILL) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) {
      ::_exit(77);
    }
    ::raise(SIGSTOP);
    ::_exit(deed() ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  if (!WIFSTOPPED(status)) {
    return std::nullopt;
  }
  for (int i = 0; i < 2 * call - 1; ++i) {  // it stops as it enters and as it leaves
    ::ptrace(PTRACE_SYSCALL, child, nullptr, nullptr);
    ::waitpid(child, &status, 0);
    if (WIFEXITED(status)) {
      return WEXITSTATUS(status) == 0 ? std::optional<bool>(false) : std::nullopt;
    }
  }
  ::kill(child, signal);
  int passed_on = signal == SIGKILL ? SIGKILL : 0;
  do {  // it stops once more as a signal reaches it
    ::ptrace(PTRACE_CONT, child, nullptr, passed_on);
    ::waitpid(child, &status, 0);
    passed_on = WIFSTOPPED(status) ? WSTOPSIG(status) : 0;
  } while (WIFSTOPPED(status));
  return true;
}

}  // namespace tenon::bytes
