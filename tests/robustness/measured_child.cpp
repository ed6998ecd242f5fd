// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/robustness/measured_child.h"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tenon::robustness {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TENON_SANITIZED 1
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

/// Seconds that a second of an optimised program may become.
#if defined(TENON_SANITIZED) || !defined(__OPTIMIZE__)
constexpr double kSlowness = 10;
#else
constexpr double kSlowness = 1;
#endif

constexpr std::size_t kMegabyte = 1u << 20;

std::atomic<std::uint64_t> bytes_taken = 0;

/// What the child leaves in memory that it shares with the parent.
struct Report {
  double seconds;
  std::size_t bytes;
  std::uint64_t taken;
  int outcome;
  bool done;
};

/// A line "Name:   123 kB" of /proc/self/status, in bytes.
std::size_t status_line(const char* name) {
  std::FILE* file = std::fopen("/proc/self/status", "r");
  char line[256];
  unsigned long long kilobytes = 0;
  while (file != nullptr && std::fgets(line, sizeof(line), file) != nullptr) {
    if (std::strncmp(line, name, std::strlen(name)) == 0) {
      std::sscanf(line + std::strlen(name), " %llu", &kilobytes);
    }
  }
  if (file != nullptr) {
    std::fclose(file);
  }
  return static_cast<std::size_t>(kilobytes) * 1024;
}

double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void limit_child(const Allowance& allowance) {
  const auto seconds = static_cast<rlim_t>(allowance.seconds * 10) + 1;
  const rlimit processor{seconds, seconds + 1};
  setrlimit(RLIMIT_CPU, &processor);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  if (!kSanitized) {
    const rlim_t most = status_line("VmSize:") + 10 * allowance.bytes;
    const rlimit memory{most, most};
    setrlimit(RLIMIT_AS, &memory);
  }
}

[[noreturn]] void run_child(const std::function<int()>& work, const Allowance& allowance,
                            Report& report) {
  limit_child(allowance);
  const std::size_t before = status_line("VmRSS:");
  const double start = processor_seconds();
  const std::uint64_t taken_before = bytes_taken;
  report.outcome = work();
  report.taken = bytes_taken - taken_before;
  report.seconds = processor_seconds() - start;
  const std::size_t most = status_line("VmHWM:");
  report.bytes = most > before ? most - before : 0;
  report.done = true;
  _exit(0);
}

}  // namespace

#if !defined(TENON_SANITIZED)
/// Counts, then takes memory as always.
void* counted_new(std::size_t size) {
  bytes_taken.fetch_add(size, std::memory_order_relaxed);
  void* const memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) {
    std::abort();
  }
  return memory;
}
#endif

Allowance allowance_of(std::size_t input_size) {
  const auto megabytes = static_cast<double>(input_size / kMegabyte + 1);
  return {kSlowness * megabytes, 64 * kMegabyte + 40 * input_size};
}

std::string Cost::excess(const Allowance& allowance, Judge judge) const {
  if (!failure.empty()) {
    return failure;
  }
  if (judge == Judge::Time && seconds > allowance.seconds) {
    return "time: " + std::to_string(seconds) + " s";
  }
  if (!kSanitized && bytes > allowance.bytes) {
    return "memory: " + std::to_string(bytes >> 20) + " MB";
  }
  return "";
}

Cost measure(const std::function<int()>& work, const Allowance& allowance) {
  void* const shared =
      mmap(nullptr, sizeof(Report), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  auto& report = *static_cast<Report*>(shared);
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    run_child(work, allowance, report);
  }
  int status = 0;
  waitpid(child, &status, 0);
  Cost cost{report.seconds, report.bytes, report.taken, "", report.outcome};
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)) {
    cost.failure = "time: ended";
  } else if (WIFSIGNALED(status)) {
    cost.failure = "crash: " + std::string(strsignal(WTERMSIG(status)));
  } else if (!report.done) {
    cost.failure = "crash: left with " + std::to_string(WEXITSTATUS(status));
  }
  munmap(shared, sizeof(Report));
  return cost;
}

}  // namespace tenon::robustness

#if !defined(TENON_SANITIZED)
void* operator new(std::size_t size) { return tenon::robustness::counted_new(size); }
void* operator new[](std::size_t size) { return tenon::robustness::counted_new(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
#endif
