// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/write/folder_lock.h"

#include <cerrno>
#include <map>

#include <fcntl.h>
#include <sys/file.h>
#include <time.h>
#include <unistd.h>

#include "tenon/bytes/posix_files.h"

namespace tenon::bytes {
namespace {

constexpr int kTries = 6000;
constexpr long kPauseNs = 5'000'000;  // between tries: half a minute in all

/// 0, EWOULDBLOCK after all tries, or the error of a file system without such locks.
int lock_patiently(int descriptor) {
  for (int i = 0; i < kTries; ++i) {
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) {
      return 0;
    }
    if (errno != EWOULDBLOCK && errno != EINTR) {
      return errno;
    }
    const timespec pause{0, kPauseNs};
    ::nanosleep(&pause, nullptr);
  }
  return EWOULDBLOCK;
}

}  // namespace

Result<FolderLock> FolderLock::take(const std::set<std::string>& folders) {
  std::map<FileIdentity, std::string> ordered;  // each once, by whatever name
  for (const std::string& folder : folders) {
    if (const auto stamp = stamp_of(folder)) {
      ordered.emplace(stamp->identity, folder);
    }
  }
  FolderLock lock;
  for (const auto& [identity, folder] : ordered) {
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) {
      continue;
    }
    lock.descriptors_.push_back(descriptor);
    if (lock_patiently(descriptor) == EWOULDBLOCK) {
      return Error(ErrorCode::Io, "another program has been writing in this folder for too long")
          .in_file(folder)
          .with_rule("file.locked")
          .with_fix("end that program (`fuser` names those that hold it), then run this again");
    }
  }
  return lock;
}

FolderLock::~FolderLock() {
  for (const int descriptor : descriptors_) {
    ::close(descriptor);
  }
}

}  // namespace tenon::bytes
