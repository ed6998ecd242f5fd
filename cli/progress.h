// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "cli/verb.h"

namespace tenon::cli {

/// One line on the terminal about work that takes longer than two seconds: what is being done, how
/// far it is, its rate and the time left where these are known. Nothing into a pipe or a file, and
/// nothing with --quiet. The line is taken away when something is printed and when the work is
/// done. One at a time.
class Progress {
 public:
  /// `what` is being done: "reading hand.usda".
  Progress(const Globals& globals, std::string what);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// The next part of the work, of unknown length.
  void next(std::string what);
  /// So much of `total` is done, counted in `unit`: "s", "files", "prims".
  void at(double done, double total, const char* unit);

 private:
  void tick();
  void hide();
  std::string line() const;

  using Clock = std::chrono::steady_clock;
  const bool shown_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::string what_;
  double done_ = 0;
  double total_ = 0;
  const char* unit_ = "";
  bool over_ = false;
  bool drawn_ = false;                      ///< the line stands on the terminal
  Clock::time_point start_ = Clock::now();  ///< of the whole
  Clock::time_point part_ = start_;         ///< of this part
  std::thread thread_;
};

}  // namespace tenon::cli
