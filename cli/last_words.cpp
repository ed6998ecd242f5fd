// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// MuJoCo carries libc++ and its own unwinder: an exception that leaves it meets frames of libstdc++
// and ends in a signal, which no catch sees. What runs here is called in handlers of signals and
// may only call the system. Nothing is lost by ending at once: outputs are renamed into place
// whole.
#include <array>
#include <csignal>
#include <exception>
#include <new>
#include <string_view>

#include <sys/resource.h>
#include <unistd.h>

#include "cli/exit_code.h"
#include "cli/program.h"

namespace tenon::cli {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kIsSanitized = true;
#else
constexpr bool kIsSanitized = false;
#endif

constexpr rlim_t kUsualStack = rlim_t{8} << 20;

void say(std::string_view text) {
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
}

[[noreturn]] void end(std::string_view text) {
  say(text);
  ::_exit(kFailed);
}

/// The user or a container allows less than the machine has.
bool memory_is_limited() {
  const auto limit = [](auto resource) {
    struct rlimit value = {};
    return ::getrlimit(resource, &value) == 0 ? value.rlim_cur : RLIM_INFINITY;
  };
  return limit(RLIMIT_AS) != RLIM_INFINITY || limit(RLIMIT_DATA) != RLIM_INFINITY ||
         limit(RLIMIT_STACK) < kUsualStack;
}

extern "C" void end_by_signal(int number) {
  if (number == SIGABRT) {
    end("error: a library gave up, as it does where the system gives it no memory, thread or file "
        "[program.library]\n  fix: allow more (`ulimit -a` lists what is allowed), or report this "
        "with the input\n");
  }
  if (number == SIGBUS) {
    end("error: a file became shorter while it was read, or cannot be read any more "
        "[program.file]\n  fix: run this again when nobody writes the file\n");
  }
  if (memory_is_limited()) {
    end("error: out of memory: a limit of the system is met [program.memory]\n"
        "  fix: allow more (ulimit -v, ulimit -s)\n");
  }
  say("error: the program crashed [program.crash]\n  fix: please report this with the input\n");
  std::signal(number, SIG_DFL);
  std::raise(number);
}

[[noreturn]] void end_by_exception() {
  constexpr std::string_view kUnknown =
      "error: an exception ended the program [program.exception]\n"
      "  fix: please report this with the input\n";
  try {
    if (const std::exception_ptr thrown = std::current_exception()) {
      std::rethrow_exception(thrown);
    }
  } catch (const std::bad_alloc&) {
    end("error: out of memory [program.memory]\n  fix: allow more (ulimit -v)\n");
  } catch (const std::exception& error) {
    say("error: ");
    say(error.what());
    end(" [program.exception]\n  fix: allow more threads and files (ulimit -u, ulimit -n), or "
        "report this with the input\n");
  } catch (...) {
    end(kUnknown);
  }
  end(kUnknown);
}

}  // namespace

void leave_last_words() {
  if (kIsSanitized) {
    return;
  }
  std::set_terminate(&end_by_exception);
  static std::array<char, std::size_t{64} << 10> stack;  // the usual one may be what is used up
  stack_t own = {};
  own.ss_sp = stack.data();
  own.ss_size = stack.size();
  ::sigaltstack(&own, nullptr);
  struct sigaction action = {};
  action.sa_handler = &end_by_signal;
  action.sa_flags = SA_ONSTACK | SA_RESETHAND;
  for (const int number : {SIGABRT, SIGSEGV, SIGBUS}) {
    ::sigaction(number, &action, nullptr);
  }
}

}  // namespace tenon::cli
