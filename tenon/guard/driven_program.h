// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

#include "tenon/base/result.h"

namespace tenon::guard {

/// The first of `names` that is a program: one with a slash as it stands, else by the folders of
/// the environment variable PATH. Nothing where there is none.
std::optional<std::string> find_program(const std::vector<std::string>& names);

/// Whether this process runs as the machine's administrator.
bool runs_as_root();

/// What comes of waiting for a program.
enum class Waiting : std::uint8_t {
  Done,     ///< all is sent, or a message is there
  Late,     ///< time is up; what was begun can be gone on with
  Ended,    ///< it has closed its end
  TooLong,  ///< it sent more than a message may have
};

/// Another program that runs beside this one, in a process group of its own: it reads what is sent
/// from descriptor 3 and answers on descriptor 4, in messages that end with a zero byte. Standard
/// input and output lead nowhere, the end of what it says on standard error is kept, and it gets no
/// other open file. Killed with everything it has started, whatever that does, with this.
class DrivenProgram {
 public:
  using Milliseconds = std::chrono::milliseconds;

  struct Settings {
    std::vector<std::string> arguments;
    std::vector<std::string> environment;  ///< "NAME=value", over that of this process
    std::size_t longest = 1u << 20;        ///< what a message of it may have [bytes]
  };
  /// Starts `program`, a path. Errors: Missing where it cannot be started.
  static Result<std::unique_ptr<DrivenProgram>> start(const std::string& program,
                                                      const Settings& settings);
  /// Of `start`: the process and this side of its sockets.
  struct Started {
    pid_t process = 0;
    int to = -1;
    int from = -1;
    int errors = -1;
  };
  DrivenProgram(const Started& started, std::size_t longest)
      : started_(started), longest_(longest) {}
  DrivenProgram(const DrivenProgram&) = delete;
  DrivenProgram& operator=(const DrivenProgram&) = delete;
  ~DrivenProgram();

  /// Puts a message, without its zero byte, behind those that are not sent yet.
  void post(std::string_view message);
  /// Sends what is posted and waits for the next message. Late: nothing was lost, wait again.
  Waiting receive(std::string& message, Milliseconds at_most);
  /// The end of what it has said on standard error.
  const std::string& last_words() const { return last_words_; }

  /// Ends it and all that it has started; waits for that, two seconds at most.
  void end();

 private:
  bool take_message(std::string& message);
  /// Bytes that wait in a socket go to `bytes`; false at the end.
  static bool read_from(int socket, std::string& bytes);
  bool write_some();
  void hear_errors();

  Started started_;
  std::size_t longest_;
  std::string unsent_;
  std::size_t sent_ = 0;  // of unsent_
  std::string received_;
  std::size_t searched_ = 0;  // of received_: no zero byte is in it
  std::string last_words_;
};

}  // namespace tenon::guard
