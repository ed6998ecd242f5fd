// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// tenon-worker: reads files in third-party formats, one after the other, for the program that
// started it and that holds the other end of its standard input. Its answers are not trusted.
#include <cerrno>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/socket.h>
#include <unistd.h>

#include "tenon/base/wire.h"
#include "tenon/guard/messages.h"
#include "tenon/mesh/assimp_scene.h"
#include "tenon/robot/robot_model.h"
#include "worker/confine.h"
#include "worker/open_files.h"

#if TENON_WITH_MUJOCO
#include "tenon/engines/mujoco/mujoco_library.h"
#include "tenon/mjcf/read_mjcf.h"
#endif

namespace tenon::worker {
namespace {

using guard::Reader;
using guard::WorkerExit;

constexpr int kParent = STDIN_FILENO;
constexpr std::size_t kMaxTaskBytes = 16u << 20;

[[noreturn]] void leave(WorkerExit how) { _exit(static_cast<int>(how)); }

/// Ends the worker where the parent has left.
void read_all(void* to, std::size_t size) {
  auto* at = static_cast<char*>(to);
  while (size > 0) {
    const ssize_t got = recv(kParent, at, size, 0);
    if (got > 0) {
      at += got;
      size -= static_cast<std::size_t>(got);
    } else if (got == 0 || errno != EINTR) {
      leave(WorkerExit::Done);
    }
  }
}

void write_all(const void* from, std::size_t size) {
  const auto* at = static_cast<const char*>(from);
  while (size > 0) {
    const ssize_t sent = send(kParent, at, size, MSG_NOSIGNAL);
    if (sent > 0) {
      at += sent;
      size -= static_cast<std::size_t>(sent);
    } else if (errno != EINTR) {
      leave(WorkerExit::Done);
    }
  }
}

/// Sends what is encoded as it comes, so that it is never there twice.
class ParentSink {
 public:
  ParentSink() { held_.reserve(kPiece); }
  ~ParentSink() { write_all(held_.data(), held_.size()); }
  ParentSink(const ParentSink&) = delete;
  ParentSink& operator=(const ParentSink&) = delete;

  void put(const void* bytes, std::size_t count) {
    if (held_.size() + count > kPiece) {
      write_all(held_.data(), held_.size());
      held_.clear();
    }
    if (count > kPiece) {
      write_all(bytes, count);
    } else {
      held_.append(static_cast<const char*>(bytes), count);
    }
  }

 private:
  static constexpr std::size_t kPiece = 1u << 16;
  std::string held_;
};

guard::Task next_task() {
  std::uint64_t size = 0;
  read_all(&size, sizeof(size));
  if (size > kMaxTaskBytes) {
    leave(WorkerExit::BadTask);
  }
  std::string bytes(size, '\0');
  read_all(bytes.data(), bytes.size());
  std::optional<guard::Task> task = wire::decoded<guard::Task>(bytes);
  if (!task) {
    leave(WorkerExit::BadTask);
  }
  return *std::move(task);
}

/// The findings that may be sent, with a word about those that may not.
std::vector<Diagnostic> taken(const Diagnostics& findings) {
  std::vector<Diagnostic> all = findings.items();
  if (all.size() > limits::kGuardFindings) {
    all.resize(limits::kGuardFindings);
    all.back().message = "further findings about this file are not given";
  }
  return all;
}

template <class T>
void reply(Result<T> result, const Diagnostics& findings, const guard::Allowance& allowance) {
  guard::Answer<T> answer;
  if (result) {
    answer.value = *std::move(result);
  } else {
    answer.failure = guard::Failure{result.error().code(), result.error().diagnostic()};
  }
  answer.findings = taken(findings);
  answer.refused = take_refused();
  answer.opened = take_opened();
  const std::uint64_t size = wire::encoded_size(answer);
  if (size > allowance.reply_bytes) {
    leave(WorkerExit::LongReply);
  }
  ParentSink sink;
  wire::encode(sink, size);
  wire::encode(sink, answer);
}

guard::AboutWorker about(const guard::Confinement& confinement) {
  guard::AboutWorker parts;
  parts.assimp = mesh::assimp_version();
#if TENON_WITH_MUJOCO
  if (engines::mujoco::open_mujoco()) {
    parts.mujoco = mj_versionString();
  }
#endif
  parts.confinement = confinement;
  return parts;
}

#if TENON_WITH_MUJOCO
Result<robot::RobotModel> read_model(const std::string& file, Diagnostics& findings) {
  return mjcf::read_mjcf(file, findings);
}
#else
Result<robot::RobotModel> read_model(const std::string& file, Diagnostics&) {
  return Error(ErrorCode::Missing, "MJCF is read by MuJoCo, which this build is without")
      .in_file(file)
      .with_rule("mjcf.missing")
      .with_fix("build with -DTENON_WITH_MUJOCO=ON");
}
#endif

void serve(const guard::Task& task, const guard::Confinement& confinement) {
  Diagnostics findings;
  switch (task.request.reader) {
    case Reader::About:
      reply<guard::AboutWorker>(about(confinement), findings, task.allowance);
      break;
    case Reader::Mesh:
      reply(mesh::read_with_assimp(task.request.file, findings), findings, task.allowance);
      break;
    case Reader::Mjcf:
      reply(read_model(task.request.file, findings), findings, task.allowance);
      break;
  }
}

/// Opens what the reader works with, while libraries may still be read.
void open_libraries(Reader reader) {
  if (reader != Reader::Mjcf) {
    mesh::has_assimp();
  }
#if TENON_WITH_MUJOCO
  if (reader != Reader::Mesh && !engines::mujoco::open_mujoco()) {
    return;  // a reader reports the failure
  }
#endif
}

[[noreturn]] void run() {
  prepare();
  guard::Task task = next_task();
  open_libraries(task.request.reader);
  const guard::Confinement confinement = confine(task.request.readable_roots);
  for (;;) {
    hold_to(task.request.readable_roots);
    allow(task.allowance);
    serve(task, confinement);
    rest();
    task = next_task();
  }
}

}  // namespace
}  // namespace tenon::worker

int main(int count, char** words) {
  if (count > 3 && std::string_view(words[1]) == "run") {
    tenon::worker::run_confined(count - 2, words + 2);
  }
  tenon::worker::run();
}
