// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/atomic_write.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tenon::bytes {
namespace {

Error write_error(const std::string& path, int number) {
  return Error(ErrorCode::Io, std::string("cannot write the file: ") + std::strerror(number))
      .in_file(path)
      .with_rule("file.unwritable");
}

/// The file that links lead to; `path` itself when there is none yet.
std::string follow_links(const std::string& path) {
  char* real = ::realpath(path.c_str(), nullptr);
  if (real == nullptr) {
    return path;
  }
  std::string result = real;
  std::free(real);
  return result;
}

/// Permissions of the file that is replaced, else those of a new file.
mode_t permissions(const std::string& path) {
  struct stat info = {};
  if (::stat(path.c_str(), &info) == 0) {
    return info.st_mode & 07777u;
  }
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666u & ~mask;
}

/// 0 or the error number.
int write_all(int descriptor, std::string_view contents) {
  while (!contents.empty()) {
    const ssize_t written = ::write(descriptor, contents.data(), contents.size());
    if (written < 0 && errno == EINTR) {
      continue;
    }
    if (written < 0) {
      return errno;
    }
    contents.remove_prefix(static_cast<std::size_t>(written));
  }
  return ::fsync(descriptor) == 0 ? 0 : errno;
}

void sync_folder(const std::string& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor >= 0) {
    ::fsync(descriptor);  // the rename is done; that it may be lost in a power cut is no error
    ::close(descriptor);
  }
}

}  // namespace

Result<void> write_file(const std::string& path, std::string_view contents) {
  const std::string target = follow_links(path);
  const std::size_t slash = target.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : target.substr(0, slash + 1);
  const std::string name = slash == std::string::npos ? target : target.substr(slash + 1);
  std::string temporary = folder + "/." + name + ".XXXXXX";
  const int descriptor = ::mkstemp(temporary.data());
  if (descriptor < 0) {
    return write_error(path, errno);
  }
  int error = ::fchmod(descriptor, permissions(target)) == 0 ? 0 : errno;
  if (error == 0) {
    error = write_all(descriptor, contents);
  }
  if (::close(descriptor) != 0 && error == 0) {
    error = errno;
  }
  if (error == 0 && ::rename(temporary.c_str(), target.c_str()) != 0) {
    error = errno;
  }
  if (error != 0) {
    ::unlink(temporary.c_str());
    return write_error(path, error);
  }
  sync_folder(folder);
  return {};
}

}  // namespace tenon::bytes
