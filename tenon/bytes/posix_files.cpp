// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/posix_files.h"

#include <atomic>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <unistd.h>

namespace tenon::bytes {

Error unwritable(const std::string& path, const char* kind, int number) {
  const bool full = number == ENOSPC || number == EDQUOT || number == EFBIG;
  const bool closed = number == EACCES || number == EPERM || number == EROFS;
  return Error(ErrorCode::Io,
               std::string("cannot write the ") + kind + ": " + std::strerror(number))
      .in_file(path)
      .with_rule("file.unwritable")
      .with_fix(full     ? "make room, or write to another disk"
                : closed ? "allow writing in its folder, or write elsewhere"
                         : std::string("name a ") + kind + " in a folder that exists");
}

Result<void> check_parent(const std::string& path, const std::string& shown, const char* kind) {
  const std::string parent = std::filesystem::path(path).parent_path().string();
  if (::access(parent.empty() ? "." : parent.c_str(), W_OK | X_OK) != 0) {
    return unwritable(shown, kind, errno);
  }
  return {};
}

int write_all(int descriptor, std::string_view contents) {
  while (!contents.empty()) {
    const ssize_t written = ::write(descriptor, contents.data(), contents.size());
    if (written < 0 && errno == EINTR) {
      continue;
    }
    if (written <= 0) {
      return written < 0 ? errno : ENOSPC;
    }
    contents.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

int read_up_to(int descriptor, std::string& contents) {
  std::size_t done = 0;
  while (done < contents.size()) {
    const ssize_t got = ::read(descriptor, contents.data() + done, contents.size() - done);
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got < 0) {
      return errno;
    }
    if (got == 0) {
      break;  // shortened meanwhile
    }
    done += static_cast<std::size_t>(got);
  }
  contents.resize(done);
  return 0;
}

FileStamp stamp_from(const struct stat& info) {
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  FileStamp stamp;
  stamp.identity = {info.st_dev, info.st_ino};
  stamp.size = info.st_size;
  stamp.modified_ns = info.st_mtim.tv_sec * kNanoseconds + info.st_mtim.tv_nsec;
  stamp.changed_ns = info.st_ctim.tv_sec * kNanoseconds + info.st_ctim.tv_nsec;
  return stamp;
}

namespace {

int sync(const std::string& path, int flags) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags);
  if (descriptor < 0) {
    return errno;
  }
  const int error = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  return error;
}

}  // namespace

void begin_to_store(int descriptor) {
#ifdef SYNC_FILE_RANGE_WRITE
  ::sync_file_range(descriptor, 0, 0, SYNC_FILE_RANGE_WRITE);
#else
  static_cast<void>(descriptor);
#endif
}

int sync_file(const std::string& file) { return sync(file, 0); }

int sync_folder(const std::string& folder) { return sync(folder, O_DIRECTORY); }

std::string next_hidden_name(const std::string& folder) {
  static std::atomic<unsigned> counter{0};
  return folder + ".tenon-" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
}

}  // namespace tenon::bytes
