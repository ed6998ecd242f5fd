// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

#include "tenon/base/result.h"
#include "tenon/guard/messages.h"

/// Internal to this folder.
namespace tenon::guard {

/// Why nothing came back.
enum class Silence : std::uint8_t {
  None,     ///< an answer came
  Ended,    ///< the process is gone
  Late,     ///< no answer in time
  TooLong,  ///< it announced more bytes than it may send
};

/// Bytes that came, in memory that is kept for the next.
class ReplyBuffer {
 public:
  std::string_view bytes() const { return {memory_.get(), size_}; }
  void clear() { size_ = 0; }
  /// Room for `more` bytes behind the others, which are counted once they are there.
  char* room_for(std::size_t more);
  void add(std::size_t count) { size_ += count; }

 private:
  std::unique_ptr<char[]> memory_;
  std::size_t capacity_ = 0;
  std::size_t size_ = 0;
};

/// A running worker and the socket to it. Ended, whatever it does, with this.
class WorkerProcess {
 public:
  /// Starts the program; errors: Missing.
  static Result<std::unique_ptr<WorkerProcess>> start(const std::string& program);
  WorkerProcess(pid_t process, int socket) : process_(process), socket_(socket) {}
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;
  ~WorkerProcess();

  /// What it has been confined to by its first task, which stays so.
  Reader reader = Reader::About;
  std::vector<std::string> roots;

  /// Sends `task` and waits for what comes back.
  Silence exchange(const std::string& task, const Allowance& allowance, ReplyBuffer& answer);

  /// Ends it and returns the status of waitpid; -1 where somebody else has it.
  int end();

 private:
  using Clock = std::chrono::steady_clock;
  bool wait_until(Clock::time_point deadline, short events) const;
  Silence send(const char* bytes, std::size_t size, Clock::time_point deadline) const;
  Silence receive(char* bytes, std::size_t size, Clock::time_point deadline) const;

  pid_t process_;
  int socket_;
};

}  // namespace tenon::guard
