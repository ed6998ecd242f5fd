// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/write/held_signals.h"

#include <array>
#include <csignal>

namespace tenon::bytes {
namespace {

constexpr std::array kEndings{SIGHUP, SIGINT, SIGTERM};

/// Of one thread.
struct Holds {
  int count = 0;
  sigset_t before{};  // the mask that the first one found
};

Holds& holds_of_thread() {
  thread_local Holds holds;
  return holds;
}

bool is_ignored(int number) {
  struct sigaction action = {};
  return ::sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void HeldSignals::begin() {
  if (holds_) {
    return;
  }
  holds_ = true;
  Holds& holds = holds_of_thread();
  if (holds.count++ == 0) {
    sigset_t endings;
    ::sigemptyset(&endings);
    for (const int number : kEndings) {
      ::sigaddset(&endings, number);
    }
    ::pthread_sigmask(SIG_BLOCK, &endings, &holds.before);
  }
}

void HeldSignals::end() {
  if (!std::exchange(holds_, false)) {
    return;
  }
  Holds& holds = holds_of_thread();
  if (--holds.count == 0) {
    ::pthread_sigmask(SIG_SETMASK, &holds.before, nullptr);
  }
}

bool is_asked_to_end() {
  const Holds& holds = holds_of_thread();
  sigset_t waiting;
  if (holds.count == 0 || ::sigpending(&waiting) != 0) {
    return false;
  }
  for (const int number : kEndings) {
    // What the caller itself kept waiting before is its own affair.
    if (::sigismember(&waiting, number) == 1 && ::sigismember(&holds.before, number) == 0 &&
        !is_ignored(number)) {
      return true;
    }
  }
  return false;
}

}  // namespace tenon::bytes
