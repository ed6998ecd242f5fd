// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "worker/confine.h"

#include <algorithm>
#include <csignal>
#include <limits>
#include <new>

#include <linux/capability.h>
#include <malloc.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "tenon/base/limits/guard_limits.h"

#if defined(__SANITIZE_ADDRESS__)
#define TENON_ADDRESS_SANITIZER 1
#elif defined(__SANITIZE_THREAD__)
#define TENON_THREAD_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define TENON_ADDRESS_SANITIZER 1
#elif __has_feature(thread_sanitizer)
#define TENON_THREAD_SANITIZER 1
#endif
#endif

// Sanitizers reserve terabytes of address space, so that they bound what is in use themselves.
// Faults of libraries end the process as they do without them.
#define TENON_SANITIZER_OPTIONS                                                      \
  "hard_rss_limit_mb=1024:exitcode=67:handle_segv=0:handle_abort=0:handle_sigbus=0:" \
  "handle_sigfpe=0:handle_sigill=0"
#if defined(TENON_ADDRESS_SANITIZER)
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() {
  return TENON_SANITIZER_OPTIONS ":detect_leaks=0";
}
constexpr bool kBoundsAddresses = false;
#elif defined(TENON_THREAD_SANITIZER)
extern "C" const char* __tsan_default_options();
extern "C" const char* __tsan_default_options() { return TENON_SANITIZER_OPTIONS; }
constexpr bool kBoundsAddresses = false;
#else
constexpr bool kBoundsAddresses = true;
#endif

namespace tenon::worker {
namespace {

constexpr rlim_t kStack = 8u << 20;
constexpr int kHeaps = 2;  // each reserves address space
constexpr int kLargePiece = 32 << 20;

void set_limit(int which, rlim_t soft, rlim_t hard) {
  rlimit limit{};
  getrlimit(static_cast<__rlimit_resource_t>(which), &limit);
  limit.rlim_max = std::min(limit.rlim_max, hard);
  limit.rlim_cur = std::min(soft, limit.rlim_max);
  setrlimit(static_cast<__rlimit_resource_t>(which), &limit);
}

rlim_t soft_limit(int which) {
  rlimit limit{};
  getrlimit(static_cast<__rlimit_resource_t>(which), &limit);
  return limit.rlim_cur;
}

/// Whole seconds of processor time so far, the nearest number: the kernel counts no parts.
rlim_t seconds_used() {
  constexpr auto kSecond = 1'000'000;
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto parts = used.ru_utime.tv_usec + used.ru_stime.tv_usec + kSecond / 2;
  return static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec + parts / kSecond);
}

[[noreturn]] void out_of_memory() { _exit(static_cast<int>(guard::WorkerExit::OutOfMemory)); }

}  // namespace

void drop_capabilities() {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct data[2]{};
  if (syscall(SYS_capget, &header, data) != 0) {
    return;
  }
  const std::uint32_t kept = 1u << CAP_DAC_READ_SEARCH;
  data[0].effective &= kept;
  data[0].permitted &= kept;
  data[0].inheritable = 0;
  data[1] = {};
  syscall(SYS_capset, &header, data);
}

void prepare() {
  set_limit(RLIMIT_CORE, 0, 0);
  set_limit(RLIMIT_FSIZE, 0, 0);
  constexpr rlim_t kFiles = limits::kGuardOpenFiles;
  set_limit(RLIMIT_NOFILE, kFiles, kFiles);
  set_limit(RLIMIT_STACK, kStack, RLIM_INFINITY);
  mallopt(M_ARENA_MAX, kHeaps);
  mallopt(M_MMAP_THRESHOLD, kLargePiece);  // what is freed after one file is there for the next
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  std::set_new_handler(out_of_memory);
}

guard::Confinement confine(const std::vector<std::string>& roots) {
  guard::Confinement in_force;
  in_force.memory = kBoundsAddresses;
  if (kBoundsAddresses) {
    set_limit(RLIMIT_AS, RLIM_INFINITY, limits::kGuardMemoryMax);
  }
  in_force.no_new_privileges = prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0;
  in_force.landlock = restrict_files(roots);
  drop_capabilities();
  in_force.system_calls = restrict_system_calls();
  return in_force;
}

void allow(const guard::Allowance& allowance) {
  if (kBoundsAddresses) {
    set_limit(RLIMIT_AS, allowance.memory, RLIM_INFINITY);
  }
  set_limit(RLIMIT_CPU, seconds_used() + allowance.seconds, RLIM_INFINITY);
  // Where the parent is gone and the rest waits for ever.
  alarm(static_cast<unsigned>(std::min<std::uint64_t>(allowance.wall_seconds + 1, 1u << 20)));
}

void rest() { alarm(0); }

void allow_more(std::uint64_t size) {
  size = std::min(size, limits::kGuardMemoryMax);
  if (kBoundsAddresses) {
    set_limit(RLIMIT_AS, soft_limit(RLIMIT_AS) + size * limits::kGuardMemoryPerByte, RLIM_INFINITY);
  }
  set_limit(RLIMIT_CPU, soft_limit(RLIMIT_CPU) + size / limits::kGuardBytesPerSecond,
            RLIM_INFINITY);
}

}  // namespace tenon::worker
