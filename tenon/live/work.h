// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "tenon/answers/json.h"

namespace tenon::live {

/// A long request while it is answered on another thread: how far it is, what it has found so far,
/// and whether it is to end. Safe from two threads.
class Work {
 public:
  Work(std::uint64_t client, std::string request) : client_(client), request_(std::move(request)) {}

  std::uint64_t client() const { return client_; }  ///< who asked
  const std::string& request() const { return request_; }

  // ---- the session

  void end() { ended_ = true; }
  bool is_over() const { return over_; }
  /// A notice `progress`; null where nothing has changed since the last one.
  answers::Json take_progress();
  /// Notices of what was found since the last call.
  std::vector<answers::Json> take_found();

  // ---- the thread that works

  bool is_ended() const { return ended_; }
  void at(double done, std::string what);  ///< `done` from 0 to 1
  void found(answers::Json notice);
  void finish() { over_ = true; }

 private:
  const std::uint64_t client_;
  const std::string request_;
  std::atomic<bool> ended_{false};
  std::atomic<bool> over_{false};
  std::mutex mutex_;
  bool changed_ = false;
  double done_ = 0;
  std::string what_;
  std::vector<answers::Json> found_;
};

}  // namespace tenon::live
