// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/progress.h"

#include <atomic>
#include <cstdio>

#include "cli/print.h"
#include "cli/text/terminal_text.h"

namespace tenon::cli {
namespace {

constexpr std::chrono::milliseconds kSilence{2000};  // short work says nothing
constexpr std::chrono::milliseconds kPeriod{200};

std::atomic<Progress*> current = nullptr;

std::string short_number(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, value < 100 ? "%.3g" : "%.0f", value);
  return buffer;
}

}  // namespace

Progress::Progress(const Globals& globals, std::string what)
    : shown_(stderr_is_terminal() && !globals.quiet), what_(std::move(what)) {
  if (shown_) {
    current = this;
    set_before_print([] {
      if (Progress* progress = current.load()) {
        progress->hide();
      }
    });
    thread_ = std::thread([this] { tick(); });
  }
}

Progress::~Progress() {
  if (!shown_) {
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  wake_.notify_one();
  thread_.join();
  hide();
  set_before_print(nullptr);
  current = nullptr;
}

void Progress::hide() {
  const std::lock_guard lock(mutex_);
  if (drawn_) {
    std::fputs("\r\033[K", stderr);
    drawn_ = false;
  }
}

void Progress::next(std::string what) {
  if (shown_) {
    const std::lock_guard lock(mutex_);
    what_ = std::move(what);
    total_ = 0;
    part_ = Clock::now();
  }
}

void Progress::at(double done, double total, const char* unit) {
  if (shown_) {
    const std::lock_guard lock(mutex_);
    done_ = done;
    total_ = total;
    unit_ = unit;
  }
}

void Progress::tick() {
  std::unique_lock lock(mutex_);
  if (wake_.wait_for(lock, kSilence, [this] { return over_; })) {
    return;
  }
  while (!over_) {
    const std::string text = "\r" + terminal_text(line(), false) + "\033[K";
    std::fputs(text.c_str(), stderr);
    std::fflush(stderr);
    drawn_ = true;
    wake_.wait_for(lock, kPeriod, [this] { return over_; });
  }
}

std::string Progress::line() const {
  const auto now = Clock::now();
  const auto seconds = [&](Clock::time_point since) {
    return std::chrono::duration<double>(now - since).count();
  };
  std::string text = what_;
  if (total_ > 0) {
    const double rate = done_ / seconds(part_);
    text += ": " + short_number(100 * done_ / total_) + " %, " + short_number(done_) + " of " +
            short_number(total_) + " " + unit_ + ", " + short_number(rate) + " " + unit_ + "/s";
    if (rate > 0) {
      text += ", " + short_number((total_ - done_) / rate) + " s left";
    }
  }
  return text + " (" + short_number(seconds(start_)) + " s)";
}

}  // namespace tenon::cli
