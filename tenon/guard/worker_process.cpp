// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The new process has a socket for its input and no other open file that leads anywhere. Whatever
// it does, the caller is not held up for long: one deadline holds for sending the question and
// receiving the answer. A length comes in front of each message, and memory grows with the bytes
// that have come, not with that length. The end waits for the process, which is killed when it
// still runs, so none is left behind and the status tells how it ended.
#include "tenon/guard/worker_process.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tenon/guard/spawn_settings.h"

namespace tenon::guard {
namespace {

constexpr std::size_t kFirstPiece = 1u << 20;

/// The socket is standard input of the new process, the rest leads nowhere. -> 0, or the error.
int start_worker(int socket, const std::string& program, pid_t& process) {
  SpawnSettings settings;
  settings.give(socket, STDIN_FILENO);
  settings.lead_nowhere(STDOUT_FILENO);
  settings.lead_nowhere(STDERR_FILENO);
  settings.close_from(STDERR_FILENO + 1);
  std::string name = "tenon-worker";
  char* const arguments[] = {name.data(), nullptr};
  return settings.spawn(program, arguments, environ, process);
}

Error no_start(const std::string& program, int reason) {
  return Error(ErrorCode::Missing, "the program " + program +
                                       ", which reads files of this format, cannot be started: " +
                                       std::strerror(reason))
      .with_rule("guard.no-worker")
      .with_fix("let this process start others, or install tenon with its worker");
}

}  // namespace

Result<std::unique_ptr<WorkerProcess>> WorkerProcess::start(const std::string& program) {
  int sockets[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) != 0) {
    return no_start(program, errno);
  }
  pid_t process = 0;
  const int reason = start_worker(sockets[1], program, process);
  close(sockets[1]);
  if (reason != 0) {
    close(sockets[0]);
    return no_start(program, reason);
  }
  return std::make_unique<WorkerProcess>(process, sockets[0]);
}

char* ReplyBuffer::room_for(std::size_t more) {
  if (size_ + more > capacity_) {
    const std::size_t capacity = std::max(size_ + more, 2 * capacity_);
    auto larger = std::make_unique_for_overwrite<char[]>(capacity);
    if (size_ > 0) {
      std::memcpy(larger.get(), memory_.get(), size_);
    }
    memory_ = std::move(larger);
    capacity_ = capacity;
  }
  return memory_.get() + size_;
}

WorkerProcess::~WorkerProcess() { end(); }

int WorkerProcess::end() {
  if (process_ <= 0) {
    return -1;
  }
  int status = 0;
  pid_t ended = waitpid(process_, &status, WNOHANG);
  if (ended == 0) {
    kill(process_, SIGKILL);
    do {
      ended = waitpid(process_, &status, 0);
    } while (ended < 0 && errno == EINTR);
  }
  const bool known = ended == process_;
  process_ = 0;
  close(socket_);
  return known ? status : -1;
}

bool WorkerProcess::wait_until(Clock::time_point deadline, short events) const {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) {
      return false;
    }
    pollfd ready{socket_, events, 0};
    const int found = poll(&ready, 1, static_cast<int>(std::min<std::int64_t>(left, 1'000'000)));
    if (found > 0) {
      return true;
    }
    if (found < 0 && errno != EINTR) {
      return false;
    }
  }
}

Silence WorkerProcess::send(const char* bytes, std::size_t size, Clock::time_point deadline) const {
  while (size > 0) {
    const ssize_t sent = ::send(socket_, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent > 0) {
      bytes += sent;
      size -= static_cast<std::size_t>(sent);
    } else if (sent < 0 && errno != EAGAIN && errno != EINTR) {
      return Silence::Ended;
    } else if (!wait_until(deadline, POLLOUT)) {
      return Silence::Late;
    }
  }
  return Silence::None;
}

Silence WorkerProcess::receive(char* bytes, std::size_t size, Clock::time_point deadline) const {
  while (size > 0) {
    const ssize_t got = recv(socket_, bytes, size, MSG_DONTWAIT);
    if (got > 0) {
      bytes += got;
      size -= static_cast<std::size_t>(got);
    } else if (got == 0 || (errno != EAGAIN && errno != EINTR)) {
      return Silence::Ended;
    } else if (!wait_until(deadline, POLLIN)) {
      return Silence::Late;
    }
  }
  return Silence::None;
}

Silence WorkerProcess::exchange(const std::string& task, const Allowance& allowance,
                                ReplyBuffer& answer) {
  const auto deadline = Clock::now() + std::chrono::seconds(allowance.wall_seconds);
  std::uint64_t size = task.size();
  std::string message(reinterpret_cast<const char*>(&size), sizeof(size));
  message += task;
  Silence silence = send(message.data(), message.size(), deadline);
  if (silence == Silence::None) {
    silence = receive(reinterpret_cast<char*>(&size), sizeof(size), deadline);
  }
  if (silence != Silence::None) {
    return silence;
  }
  if (size > allowance.reply_bytes) {
    return Silence::TooLong;
  }
  answer.clear();
  while (answer.bytes().size() < size && silence == Silence::None) {
    const std::size_t have = answer.bytes().size();
    const std::size_t piece = std::min<std::size_t>(size - have, std::max(kFirstPiece, have));
    silence = receive(answer.room_for(piece), piece, deadline);
    answer.add(piece);
  }
  return silence;
}

}  // namespace tenon::guard
