// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// seccomp: of the system calls, those of reading, computing with threads, and memory. All others
// fail: no network, no process is started or signalled, nothing is opened to be written.
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "worker/confine.h"

namespace tenon::worker {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t kMachine = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kMachine = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t kMachine = 0;  // not known here: no filter
#endif

constexpr std::uint32_t kOtherNumbers = 0x40000000;  // of the x32 interface

constexpr int kAllowed[] = {
    SYS_read,
    SYS_readv,
    SYS_pread64,
    SYS_write,
    SYS_writev,
    SYS_recvfrom,
    SYS_sendto,
    SYS_close,
    SYS_fstat,
    SYS_newfstatat,
    SYS_statx,
    SYS_lseek,
    SYS_fcntl,
    SYS_dup,
    SYS_getdents64,
    SYS_getcwd,
    SYS_readlinkat,
    SYS_faccessat,
    SYS_faccessat2,
    SYS_fadvise64,
    SYS_mmap,
    SYS_munmap,
    SYS_mremap,
    SYS_mprotect,
    SYS_madvise,
    SYS_brk,
    SYS_futex,
    SYS_set_robust_list,
    SYS_get_robust_list,
    SYS_rseq,
    SYS_membarrier,
    SYS_sched_yield,
    SYS_sched_getaffinity,
    SYS_getcpu,
    SYS_clock_gettime,
    SYS_clock_getres,
    SYS_clock_nanosleep,
    SYS_nanosleep,
    SYS_gettimeofday,
    SYS_restart_syscall,
    SYS_getrandom,
    SYS_uname,
    SYS_sysinfo,
    SYS_getrusage,
    SYS_setitimer,
    SYS_rt_sigaction,
    SYS_rt_sigprocmask,
    SYS_rt_sigreturn,
    SYS_sigaltstack,
    SYS_getpid,
    SYS_gettid,
    SYS_getuid,
    SYS_geteuid,
    SYS_getgid,
    SYS_getegid,
    SYS_exit,
    SYS_exit_group,
#if defined(__x86_64__)
    SYS_stat,
    SYS_lstat,
    SYS_access,
    SYS_readlink,
    SYS_getdents,
    SYS_arch_prctl,
    SYS_time,
    SYS_alarm,
#endif
};

/// What an interpreter begins with, beside these.
constexpr int kAllowedForPrograms[] = {
    SYS_execve,  SYS_set_tid_address,
    SYS_getppid, SYS_ioctl,
    SYS_dup3,    SYS_pipe2,
    SYS_ppoll,   SYS_pselect6,
    SYS_fstatfs, SYS_statfs,
#if defined(__x86_64__)
    SYS_dup2,    SYS_poll,
    SYS_select,  SYS_getpgrp,
#endif
};

constexpr std::uint32_t kWrites = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | O_APPEND;

/// Builds the filter; each row is complete by itself, so that no jump is long.
class Filter {
 public:
  Filter() {
    load(offsetof(seccomp_data, arch));
    rows_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kMachine, 1, 0));
    answer(SECCOMP_RET_KILL_PROCESS);
    load(offsetof(seccomp_data, nr));
    rows_.push_back(BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, kOtherNumbers, 0, 1));
    fail(ENOSYS);
  }

  void allow(int call) {
    rows_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 1));
    answer(SECCOMP_RET_ALLOW);
  }
  void refuse(int call, int reason) {
    rows_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 1));
    fail(reason);
  }
  /// Allowed where an argument is `value`.
  void allow_with(int call, int argument, std::uint32_t value) {
    allow_if(call, argument, BPF_JEQ, value, true);
  }
  /// Allowed where an argument has one of `bits`, or none of them.
  void allow_with_bits(int call, int argument, std::uint32_t bits) {
    allow_if(call, argument, BPF_JSET, bits, true);
  }
  void allow_without_bits(int call, int argument, std::uint32_t bits) {
    allow_if(call, argument, BPF_JSET, bits, false);
  }

  bool install() {
    fail(EPERM);
    sock_fprog program{static_cast<unsigned short>(rows_.size()), rows_.data()};
    return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0) == 0;
  }

 private:
  void load(std::size_t offset) {
    rows_.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)));
  }
  void answer(std::uint32_t what) { rows_.push_back(BPF_STMT(BPF_RET | BPF_K, what)); }
  void fail(int reason) {
    answer(SECCOMP_RET_ERRNO | (static_cast<std::uint32_t>(reason) & SECCOMP_RET_DATA));
  }
  void allow_if(int call, int argument, unsigned test, std::uint32_t value, bool where_true) {
    rows_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 4));
    load(offsetof(seccomp_data, args) + 8 * static_cast<std::size_t>(argument));  // low half
    const auto code = static_cast<unsigned short>(BPF_JMP | test | BPF_K);
    rows_.push_back(where_true ? sock_filter{code, 0, 1, value} : sock_filter{code, 1, 0, value});
    answer(SECCOMP_RET_ALLOW);
    fail(EACCES);
  }

  std::vector<sock_filter> rows_;
};

/// Reading and computing.
Filter reading_alone() {
  Filter filter;
  for (const int call : kAllowed) {
    filter.allow(call);
  }
  filter.allow_without_bits(SYS_openat, 2, kWrites);
#if defined(__x86_64__)
  filter.allow_without_bits(SYS_open, 1, kWrites);
#endif
  filter.allow_with_bits(SYS_clone, 0, CLONE_THREAD);
  filter.refuse(SYS_clone3, ENOSYS);  // its flags lie in memory; the C library takes clone then
  filter.allow_with(SYS_prlimit64, 0, 0);
  filter.allow_with(SYS_tgkill, 0, static_cast<std::uint32_t>(getpid()));
  return filter;
}

}  // namespace

bool restrict_system_calls() { return kMachine != 0 && reading_alone().install(); }

bool restrict_program_calls() {
  if (kMachine == 0) {
    return false;
  }
  Filter filter = reading_alone();
  for (const int call : kAllowedForPrograms) {
    filter.allow(call);
  }
  return filter.install();
}

}  // namespace tenon::worker
