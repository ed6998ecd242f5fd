// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Python is started as a program of its own, so that this one needs no Python to be built or to
// run. A verb hands on its streams; a page waits for the output, whose pipes are read in turn.
#include "cli/python/python_program.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tenon/base/limits/run_limits.h"

namespace tenon::cli {
namespace {

constexpr int kNoPackage = 104;

/// An empty entry of sys.path is the working directory, where anybody may have put a tenon_usd.
constexpr const char* kStart =
    "import sys\n"
    "sys.path[:] = [path for path in sys.path if path]\n"
    "import importlib, importlib.util\n"
    "if importlib.util.find_spec('tenon_usd') is None: sys.exit(104)\n"
    "sys.exit(importlib.import_module(sys.argv[1]).main(sys.argv[2:]))\n";

Error no_python(const std::string& why) {
  return Error(ErrorCode::Missing, "this verb is in tenon's Python package: " + why)
      .with_rule("python.missing")
      .with_fix(
          "install its wheel (make wheel && pip install dist/tenon_usd-*.whl) for the python3 of "
          "the PATH, or for the one that TENON_PYTHON names");
}

/// The exit code of a child; that of a shell for one that a signal ended.
int wait_for(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  constexpr int kSignalled = 128;
  return WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status);
}

std::string python_name() {
  const char* named = std::getenv("TENON_PYTHON");
  return named != nullptr && *named != '\0' ? named : "python3";
}

Result<pid_t> start_python(const std::string& module, const std::vector<std::string>& arguments,
                           const posix_spawn_file_actions_t* streams) {
  std::vector<std::string> words = {python_name(), "-c", kStart, module};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) {
    pointers.push_back(word.data());
  }
  pointers.push_back(nullptr);
  pid_t process = 0;
  if (posix_spawnp(&process, pointers[0], streams, nullptr, pointers.data(), environ) != 0) {
    return no_python(words[0] + " cannot be started");
  }
  return process;
}

/// The end of a pipe that is read, and what came out of it.
struct Stream {
  int from = -1;
  int to = -1;
  std::string text;

  Stream() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) == 0) {
      from = ends[0];
      to = ends[1];
    }
  }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  ~Stream() {
    end(from);
    end(to);
  }
  static void end(int& descriptor) {
    if (descriptor >= 0) {
      ::close(std::exchange(descriptor, -1));
    }
  }
  /// Reads once; closes `from` at its end.
  void read() {
    std::array<char, 65536> part{};
    const ssize_t count = ::read(from, part.data(), part.size());
    if (count > 0) {
      text.append(part.data(), static_cast<std::size_t>(count));
    } else if (count == 0 || errno != EINTR) {
      end(from);
    }
  }
};

constexpr std::size_t kMostComplaint = 4096;
constexpr int kLookAgain = 100;  // [ms]
constexpr auto kPatience = std::chrono::seconds(10);

/// Interrupts a process once, and kills it later.
class Ending {
 public:
  explicit Ending(pid_t process) : process_(process) {}
  void ask() {
    const auto now = std::chrono::steady_clock::now();
    if (!asked_) {
      kill(process_, SIGINT);
      asked_ = true;
      since_ = now;
    } else if (now - since_ > kPatience) {
      kill(process_, SIGKILL);
    }
  }

 private:
  pid_t process_;
  bool asked_ = false;
  std::chrono::steady_clock::time_point since_;
};

/// Hands over the whole lines, of which `complaint` keeps the last ones.
void tell_lines(std::string& text, std::string& complaint,
                const Function<void(const std::string&)>& told) {
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n')) {
    const std::string line = text.substr(0, end);
    text.erase(0, end + 1);
    told(line);
    complaint += line + "\n";
  }
  for (std::string* each : {&complaint, &text}) {
    if (each->size() > kMostComplaint) {
      each->erase(0, each->size() - kMostComplaint);
    }
  }
}

}  // namespace

Result<int> run_python_program(const std::string& module,
                               const std::vector<std::string>& arguments) {
  TENON_TRY(const pid_t process, start_python(module, arguments, nullptr));
  const int code = wait_for(process);
  if (code == kNoPackage) {
    return no_python(python_name() + " has no package tenon_usd");
  }
  return code;
}

Result<PythonAnswer> ask_python_program(const std::string& module,
                                        const std::vector<std::string>& arguments,
                                        const Function<void(const std::string& line)>& told,
                                        const Function<bool()>& is_ended) {
  Stream output;
  Stream complaint;
  if (output.from < 0 || complaint.from < 0) {
    return Error(ErrorCode::Io, "the system gives no pipe")
        .with_rule("python.no-pipe")
        .with_fix("allow more open files (ulimit -n)");
  }
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  posix_spawn_file_actions_addopen(&streams, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&streams, output.to, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&streams, complaint.to, STDERR_FILENO);
  const Result<pid_t> process = start_python(module, arguments, &streams);
  posix_spawn_file_actions_destroy(&streams);
  if (!process) {
    return process.error();
  }
  Stream::end(output.to);
  Stream::end(complaint.to);
  PythonAnswer answer;
  Ending ending(*process);
  while (output.from >= 0 || complaint.from >= 0) {
    std::array<pollfd, 2> looked{pollfd{output.from, POLLIN, 0}, pollfd{complaint.from, POLLIN, 0}};
    ::poll(looked.data(), looked.size(), kLookAgain);
    if (looked[0].revents != 0) {
      output.read();
    }
    if (looked[1].revents != 0) {
      complaint.read();
      tell_lines(complaint.text, answer.complaint, told);
    }
    if (is_ended() || output.text.size() > limits::kPythonOutput) {
      ending.ask();
    }
  }
  answer.code = wait_for(*process);
  answer.complaint += complaint.text;
  if (answer.code == kNoPackage) {
    return no_python(python_name() + " has no package tenon_usd");
  }
  if (output.text.size() > limits::kPythonOutput) {
    return Error(ErrorCode::Limit, "the Python package printed more than 256 MiB")
        .with_rule("python.output")
        .with_fix("take fewer joints, or a shorter log");
  }
  answer.output = std::move(output.text);
  return answer;
}

}  // namespace tenon::cli
