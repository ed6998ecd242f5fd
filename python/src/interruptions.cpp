// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The library knows nothing of signals, and Python sees to them only while it runs code of its own.
// Calls that step look between blocks of steps. Calls that cannot be divided run on a thread that
// they may leave behind: it touches nothing of Python, owns what it reads, and has to ask before it
// writes. The end of the program waits for such threads, for they use what goes away there.
#include "interruptions.h"

#include <algorithm>
#include <atomic>

#include "failure.h"
#include <unistd.h>

namespace tenon::python {
namespace {

using Clock = std::chrono::steady_clock;

/// A block is as long as this up to twice as long, so that a signal waits for kBetweenLooks and one
/// block at most. The longer it is, the more steps of one environment find its state in the cache.
constexpr std::chrono::milliseconds kBlock{20};
constexpr std::size_t kMostSteps = 1u << 20;

std::atomic<std::size_t>& running_calls() {
  static std::atomic<std::size_t> count{0};
  return count;
}

/// A process that was forked has none of the threads.
std::atomic<pid_t>& their_process() {
  static std::atomic<pid_t> process{0};
  return process;
}

std::atomic<bool>& looks() {
  static std::atomic<bool> on{true};
  return on;
}

}  // namespace

void end_looks() { looks() = false; }

void look_for_signals() {
  if (!looks()) {
    return;
  }
  const nb::gil_scoped_acquire held;
  // Code of Python lets exceptions of other threads in as well, which PyErr_CheckSignals does not.
  nb::module_::import_("tenon_usd._signals").attr("look")();
}

void Interruptions::look() {
  const auto now = Clock::now();
  if (now - looked_ >= kBetweenLooks) {
    look_for_signals();
    looked_ = Clock::now();
  }
}

std::size_t BlockStepper::step(engines::Environments& environments, std::size_t count) {
  for (std::size_t done = 0;;) {
    const std::size_t steps = std::min(block_, count - done);
    const auto begun = Clock::now();
    const std::size_t failed = environments.step(steps);
    done += steps;
    if (done >= count) {
      return failed;
    }
    const auto taken = Clock::now() - begun;
    block_ = taken > 2 * kBlock ? std::max<std::size_t>(block_ / 2, 1)
             : taken < kBlock   ? std::min(block_ * 2, kMostSteps)
                                : block_;
    interruptions_.look();
  }
}

bool Leavable::go_on() const {
  const std::lock_guard<std::mutex> held(mutex_);
  return !left_;
}

bool Leavable::may_write() {
  const std::lock_guard<std::mutex> held(mutex_);
  writes_ = !left_;
  return writes_;
}

void Leavable::begin() {
  if (their_process().exchange(getpid()) != getpid()) {
    running_calls() = 0;
  }
  ++running_calls();
}

void Leavable::finish() {
  {
    const std::lock_guard<std::mutex> held(mutex_);
    is_done_ = true;
  }
  done_.notify_all();
}

void Leavable::end() { --running_calls(); }

void Leavable::wait() {
  std::unique_lock<std::mutex> held(mutex_);
  while (!done_.wait_for(held, kBetweenLooks, [this] { return is_done_; })) {
    held.unlock();
    try {
      look_for_signals();
    } catch (...) {
      held.lock();
      left_ = !writes_;
      done_.wait(held, [this] { return is_done_ || left_; });
      throw;
    }
    held.lock();
  }
}

Result<void> check_may_write(Leavable& call) {
  return call.may_write() ? Result<void>()
                          : Error(ErrorCode::Invalid, "interrupted; nothing is written");
}

void wait_for_left_calls() {
  const nb::gil_scoped_release release;
  while (running_calls() > 0 && their_process() == getpid()) {
    std::this_thread::sleep_for(kBetweenLooks / 5);
    look_for_signals();
  }
}

}  // namespace tenon::python
