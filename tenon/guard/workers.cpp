// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A worker is confined by its first task for good, so an idle one takes a further file only for the
// same reader and the same folders. A few are kept, and the one that was started first goes first.
// When no answer comes, the worker is ended, and how that came about says which bound was met.
// Bounds grow with the size of the file. After the first loss files get less processor time, and
// after kGuardLosses losses none is read, so a folder full of bad files costs a bounded time.
#include "tenon/guard/workers.h"

#include <algorithm>
#include <csignal>
#include <cstring>
#include <filesystem>

#include <sys/wait.h>

#include "tenon/base/file_finding.h"
#include "tenon/base/text/comma_list.h"
#include "tenon/guard/worker_place.h"
#include "tenon/guard/worker_process.h"

namespace tenon::guard {
namespace {

namespace fs = std::filesystem;

constexpr int kCannotRun = 127;          // what the loader of programs ends with
constexpr std::size_t kIdleWorkers = 4;  // folders that a robot's files usually lie in, and more

std::string in_megabytes(std::uint64_t bytes) { return std::to_string(bytes >> 20) + " MB"; }

Error limit(const std::string& file, const char* rule, std::string message) {
  return Error(ErrorCode::Limit, std::move(message))
      .in_file(file)
      .with_rule(rule)
      .with_fix("give a file that asks for less; docs/limits.md has the bounds");
}

Error out_of_memory(const std::string& file, const Allowance& allowance) {
  return limit(file, "guard.memory",
               "reading the file takes more memory than it may, " + in_megabytes(allowance.memory) +
                   " (kGuardMemoryBase)");
}

Error out_of_time(const std::string& file, const Allowance& allowance) {
  return limit(file, "guard.time",
               "reading the file takes longer than it may, " + std::to_string(allowance.seconds) +
                   " s of processor time (kGuardSeconds)");
}

Error too_late(const std::string& file, const Allowance& allowance) {
  return limit(file, "guard.time",
               "the file is not read after " + std::to_string(allowance.wall_seconds) +
                   " s (kGuardWallSeconds)");
}

Error too_long(const std::string& file, const Allowance& allowance) {
  return limit(file, "guard.reply",
               "the file holds more than it may when it is read, " +
                   in_megabytes(allowance.reply_bytes) + " (kGuardReplyBase)");
}

Error broken(const std::string& file, const std::string& how) {
  return Error(ErrorCode::Corrupt, "the library that reads this format broke down on the file (" +
                                       how + "); it ran in a process of its own, tenon-worker")
      .in_file(file)
      .with_rule("guard.crashed")
      .with_fix("export the file again; it is damaged or malicious");
}

/// What the end of a worker says.
Error end_of_worker(int status, const std::string& file, const Allowance& allowance) {
  if (status == -1) {
    return broken(file, "it is gone");
  }
  if (WIFEXITED(status)) {
    switch (WEXITSTATUS(status)) {
      case static_cast<int>(WorkerExit::OutOfMemory):
        return out_of_memory(file, allowance);
      case static_cast<int>(WorkerExit::LongReply):
        return too_long(file, allowance);
      case kCannotRun:
        return Error(ErrorCode::Missing,
                     "the program tenon-worker, which reads files of this format, cannot run here: "
                     "a library of it is missing")
            .in_file(file)
            .with_rule("guard.no-worker")
            .with_fix("install tenon again; `ldd` of its tenon-worker names the library");
      default:
        return broken(file, "it ended with " + std::to_string(WEXITSTATUS(status)));
    }
  }
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU) {
    return out_of_time(file, allowance);
  }
  if (signal == SIGALRM) {
    return too_late(file, allowance);
  }
  const char* name = sigabbrev_np(signal);
  return broken(file, name == nullptr ? "signal " + std::to_string(signal)
                                      : "signal SIG" + std::string(name));
}

}  // namespace

Workers::Workers(const Allowance& base) : base_(base), answer_(std::make_unique<ReplyBuffer>()) {}
Workers::~Workers() = default;

/// The processor time of a command is for its first loss; after that, files get a second each.
Allowance Workers::allowance_for(const std::string& file) const {
  std::error_code error;
  std::uint64_t size = fs::file_size(file, error);
  if (error) {
    size = 0;
  }
  size = std::min(size, limits::kGuardMemoryMax);
  Allowance allowance = base_;
  allowance.memory =
      std::min(allowance.memory + size * limits::kGuardMemoryPerByte, limits::kGuardMemoryMax);
  if (lost_ > 0) {
    allowance.seconds = 1;
  }
  allowance.seconds += size / limits::kGuardBytesPerSecond;
  allowance.wall_seconds += 4 * (size / limits::kGuardBytesPerSecond);
  allowance.reply_bytes += size * limits::kGuardReplyPerByte;
  return allowance;
}

Result<std::size_t> Workers::worker_for(const Request& request) {
  for (std::size_t i = 0; i < idle_.size(); ++i) {
    if (idle_[i]->reader == request.reader && idle_[i]->roots == request.readable_roots) {
      return i;
    }
  }
  TENON_TRY(const std::string program, worker_program());
  TENON_TRY(auto process, WorkerProcess::start(program));
  process->reader = request.reader;
  process->roots = request.readable_roots;
  ++started_;
  if (idle_.size() >= kIdleWorkers) {
    idle_.erase(idle_.begin());
  }
  idle_.push_back(std::move(process));
  return idle_.size() - 1;
}

Result<std::string_view> Workers::ask(const Request& request) {
  if (lost_ >= limits::kGuardLosses) {
    return limit(request.file, "guard.losses",
                 "the file is not read, for " + std::to_string(lost_) +
                     " files of this command broke their readers (kGuardLosses)");
  }
  if (request.readable_roots.size() > limits::kGuardRoots) {
    return limit(request.file, "guard.roots",
                 "more folders are to be readable than " + std::to_string(limits::kGuardRoots) +
                     " (kGuardRoots)");
  }
  auto at = worker_for(request);
  if (!at) {
    return std::move(at).error().in_file(request.file);
  }
  const Allowance allowance = allowance_for(request.file);
  const Silence silence =
      idle_[*at]->exchange(wire::encoded(Task{request, allowance}), allowance, *answer_);
  if (silence == Silence::None) {
    return answer_->bytes();
  }
  ++lost_;
  const int status = idle_[*at]->end();
  idle_.erase(idle_.begin() + static_cast<std::ptrdiff_t>(*at));
  if (silence == Silence::Late) {
    return too_late(request.file, allowance);
  }
  return silence == Silence::TooLong ? too_long(request.file, allowance)
                                     : end_of_worker(status, request.file, allowance);
}

std::vector<std::string> own_roots(const std::string& file) {
  std::error_code error;
  std::vector<std::string> roots;
  const fs::path absolute = fs::absolute(file, error);
  for (const fs::path& folder : {fs::canonical(absolute.parent_path(), error),
                                 fs::canonical(absolute, error).parent_path()}) {
    if (!folder.empty() && (roots.empty() || roots.front() != folder.string())) {
      roots.push_back(folder.string());
    }
  }
  return roots;
}

Error bad_answer(const std::string& file) { return broken(file, "its answer makes no sense"); }

Diagnostic refused_file(const std::string& file, const std::string& refused,
                        const std::vector<std::string>& roots) {
  const std::string folders = comma_list(roots);
  return file_finding(Severity::Error, "guard.outside",
                      "the file asks for \"" + refused +
                          "\", which is not a file in the folders that may be read (" + folders +
                          ")",
                      file, 0, "put the file there, or name its folder as one that may be read");
}

}  // namespace tenon::guard
