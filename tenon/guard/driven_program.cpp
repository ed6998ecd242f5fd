// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Sending and receiving go on at the same time, so that two sides with much to say cannot wait for
// each other. The program is the first of a process group, which is killed as a whole. The end of
// the group is seen at its standard error: each process that the program started holds it open, and
// the last one closes it.
#include "tenon/guard/driven_program.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tenon/guard/spawn_settings.h"

namespace tenon::guard {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kDrivenReads = 3;
constexpr int kDrivenWrites = 4;
constexpr int kHighDescriptor = 16;  // where no number that the program gets is in the way
constexpr std::size_t kKeptWords = 4000;
constexpr std::size_t kPiece = 1u << 18;
constexpr std::chrono::seconds kLastBreath{2};

/// Both ends of a connection, high and closed in other programs.
struct DrivenSocket {
  int ours = -1;
  int theirs = -1;

  bool open() {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
      return false;
    }
    ours = fcntl(ends[0], F_DUPFD_CLOEXEC, kHighDescriptor);
    theirs = fcntl(ends[1], F_DUPFD_CLOEXEC, kHighDescriptor);
    close(ends[0]);
    close(ends[1]);
    return ours >= 0 && theirs >= 0;
  }
  static void drop(int& end) {
    if (end >= 0) {
      close(end);
      end = -1;
    }
  }
};

/// As C has lists of texts.
std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) {
    pointers.push_back(text.data());
  }
  pointers.push_back(nullptr);
  return pointers;
}

/// The environment of this process with some of it replaced.
std::vector<std::string> environment_with(const std::vector<std::string>& more) {
  std::vector<std::string> all = more;
  for (char** row = environ; *row != nullptr; ++row) {
    const std::string_view kept = *row;
    const std::string_view name = kept.substr(0, kept.find('=') + 1);
    if (std::none_of(more.begin(), more.end(),
                     [&](const std::string& one) { return one.starts_with(name); })) {
      all.emplace_back(kept);
    }
  }
  return all;
}

/// In a process group of its own, with sockets to speak, to answer and for its standard error.
/// -> 0, or the error.
int start_driven(int to, int from, int errors, const std::string& program,
                 const DrivenProgram::Settings& settings, pid_t& process) {
  SpawnSettings spawn(POSIX_SPAWN_SETPGROUP);
  spawn.lead_nowhere(STDIN_FILENO);
  spawn.lead_nowhere(STDOUT_FILENO);
  spawn.give(errors, STDERR_FILENO);
  spawn.give(to, kDrivenReads);
  spawn.give(from, kDrivenWrites);
  spawn.close_from(kDrivenWrites + 1);
  std::vector<std::string> words{program};
  words.insert(words.end(), settings.arguments.begin(), settings.arguments.end());
  std::vector<std::string> environment = environment_with(settings.environment);
  return spawn.spawn(program, pointers_to(words).data(), pointers_to(environment).data(), process);
}

bool is_program(const std::string& path) {
  struct stat info = {};
  return stat(path.c_str(), &info) == 0 && S_ISREG(info.st_mode) && access(path.c_str(), X_OK) == 0;
}

Error cannot_start(const std::string& program, int reason) {
  return Error(ErrorCode::Missing,
               "the program cannot be started: " + std::string(std::strerror(reason)))
      .in_file(program)
      .with_rule("guard.no-program")
      .with_fix("name a program that this machine can run");
}

}  // namespace

std::optional<std::string> find_program(const std::vector<std::string>& names) {
  const char* variable = std::getenv("PATH");
  const std::string folders = variable == nullptr ? "" : variable;
  for (const std::string& name : names) {
    if (name.find('/') != std::string::npos) {
      if (is_program(name)) {
        return name;
      }
      continue;
    }
    for (std::size_t at = 0; !name.empty() && at < folders.size();) {
      const std::size_t end = std::min(folders.find(':', at), folders.size());
      std::string path = folders.substr(at, end - at) + "/" + name;
      if (path.front() == '/' && is_program(path)) {
        return path;
      }
      at = end + 1;
    }
  }
  return std::nullopt;
}

bool runs_as_root() { return geteuid() == 0; }

Result<std::unique_ptr<DrivenProgram>> DrivenProgram::start(const std::string& program,
                                                            const Settings& settings) {
  DrivenSocket to;
  DrivenSocket from;
  DrivenSocket errors;
  Started started;
  int reason = 0;
  if (!to.open() || !from.open() || !errors.open()) {
    reason = errno;
  } else {
    reason =
        start_driven(to.theirs, from.theirs, errors.theirs, program, settings, started.process);
  }
  for (DrivenSocket* socket : {&to, &from, &errors}) {
    DrivenSocket::drop(socket->theirs);
    if (reason != 0) {
      DrivenSocket::drop(socket->ours);
    }
  }
  if (reason != 0) {
    return cannot_start(program, reason);
  }
  started.to = to.ours;
  started.from = from.ours;
  started.errors = errors.ours;
  return std::make_unique<DrivenProgram>(started, settings.longest);
}

DrivenProgram::~DrivenProgram() { end(); }

void DrivenProgram::post(std::string_view message) {
  if (sent_ > kPiece) {
    unsent_.erase(0, std::exchange(sent_, 0));
  }
  unsent_ += message;
  unsent_ += '\0';
}

bool DrivenProgram::take_message(std::string& message) {
  const std::size_t end = received_.find('\0', searched_);
  if (end == std::string::npos) {
    searched_ = received_.size();
    return false;
  }
  message.assign(received_, 0, end);
  received_.erase(0, end + 1);
  searched_ = 0;
  return true;
}

bool DrivenProgram::read_from(int socket, std::string& bytes) {
  std::array<char, kPiece / 4> piece;
  for (;;) {
    const ssize_t got = recv(socket, piece.data(), piece.size(), MSG_DONTWAIT);
    if (got > 0) {
      bytes.append(piece.data(), static_cast<std::size_t>(got));
      return true;
    }
    if (got == 0 || errno != EINTR) {
      return got < 0 && errno == EAGAIN;
    }
  }
}

bool DrivenProgram::write_some() {
  while (sent_ < unsent_.size()) {
    const std::size_t size = std::min(unsent_.size() - sent_, kPiece);
    const ssize_t went =
        ::send(started_.to, unsent_.data() + sent_, size, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (went < 0 && errno != EINTR) {
      return errno == EAGAIN;
    }
    sent_ += went > 0 ? static_cast<std::size_t>(went) : 0;
  }
  unsent_.clear();
  sent_ = 0;
  return true;
}

void DrivenProgram::hear_errors() {
  if (started_.errors >= 0 && !read_from(started_.errors, last_words_)) {
    DrivenSocket::drop(started_.errors);
  }
  if (last_words_.size() > 2 * kKeptWords) {
    last_words_.erase(0, last_words_.size() - kKeptWords);
  }
}

Waiting DrivenProgram::receive(std::string& message, Milliseconds at_most) {
  const auto deadline = Clock::now() + at_most;
  while (!take_message(message)) {
    if (started_.from < 0) {
      return Waiting::Ended;
    }
    if (received_.size() > longest_) {
      return Waiting::TooLong;
    }
    const auto left = std::chrono::ceil<Milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) {
      return Waiting::Late;
    }
    const bool sends = sent_ < unsent_.size();
    std::array<pollfd, 3> ready{pollfd{started_.from, POLLIN, 0},
                                pollfd{started_.errors, POLLIN, 0},
                                pollfd{sends ? started_.to : -1, POLLOUT, 0}};
    if (poll(ready.data(), ready.size(), static_cast<int>(std::min<std::int64_t>(left, 60'000))) <=
        0) {
      continue;
    }
    if (ready[1].revents != 0) {
      hear_errors();
    }
    if (ready[2].revents != 0 && !write_some()) {
      DrivenSocket::drop(started_.to);  // what it has said before is still heard
      unsent_.clear();
      sent_ = 0;
    }
    if (ready[0].revents != 0 && !read_from(started_.from, received_)) {
      DrivenSocket::drop(started_.from);
    }
  }
  return Waiting::Done;
}

void DrivenProgram::end() {
  if (started_.process <= 0) {
    return;
  }
  kill(-started_.process, SIGKILL);
  int status = 0;
  while (waitpid(started_.process, &status, 0) < 0 && errno == EINTR) {
  }
  started_.process = 0;
  const auto deadline = Clock::now() + kLastBreath;
  while (started_.errors >= 0) {
    const auto left = std::chrono::ceil<Milliseconds>(deadline - Clock::now()).count();
    pollfd ready{started_.errors, POLLIN, 0};
    if (left <= 0 || (poll(&ready, 1, static_cast<int>(left)) < 0 && errno != EINTR)) {
      break;
    }
    if (ready.revents != 0) {
      hear_errors();
    }
  }
  DrivenSocket::drop(started_.to);
  DrivenSocket::drop(started_.from);
  DrivenSocket::drop(started_.errors);
}

}  // namespace tenon::guard
