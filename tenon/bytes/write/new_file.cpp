// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/write/new_file.h"

#include <array>
#include <cerrno>
#include <climits>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "tenon/bytes/posix_files.h"

namespace tenon::bytes {
namespace {

constexpr int kLinks = 40;  // links that lead to links

}  // namespace

std::string follow_links(std::string path) {
  for (int i = 0; i < kLinks; ++i) {
    std::array<char, PATH_MAX> buffer{};
    const ssize_t length = ::readlink(path.c_str(), buffer.data(), buffer.size());
    if (length <= 0) {
      break;
    }
    const std::string target(buffer.data(), static_cast<std::size_t>(length));
    path = target.front() == '/' ? target : path.substr(0, path.rfind('/') + 1) + target;
  }
  return path;
}

NewFile::NewFile(NewFile&& other) noexcept
    : folder_(std::move(other.folder_)),
      held_(std::move(other.held_)),
      name_(std::exchange(other.name_, {})),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

NewFile::~NewFile() {
  close();
  if (!name_.empty()) {
    ::unlink(name_.c_str());
  }
}

void NewFile::close() {
  if (descriptor_ >= 0) {
    ::close(std::exchange(descriptor_, -1));
  }
}

int NewFile::open(Name name) {
#ifdef O_TMPFILE
  const char* where = folder_.empty() ? "." : folder_.c_str();
  if (name == Name::None && ::access("/proc/self/fd", X_OK) == 0) {  // a name comes from there
    descriptor_ = ::open(where, O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  }
  if (descriptor_ >= 0) {
    return 0;
  }
#endif
  held_.begin();
  return with_free_name(folder_, name_, [&](const std::string& free) {
    descriptor_ = ::open(free.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    return descriptor_ >= 0;
  });
}

int NewFile::take_over(const struct stat& old) {
  struct stat own = {};
  if (::fstat(descriptor_, &own) == 0 && (own.st_uid != old.st_uid || own.st_gid != old.st_gid) &&
      ::fchown(descriptor_, old.st_uid, old.st_gid) != 0) {
    errno = 0;
  }
  return ::fchmod(descriptor_, old.st_mode & 07777u) == 0 ? 0 : errno;
}

int NewFile::write(std::string_view contents) {
  const int error = write_all(descriptor_, contents);
  begin_to_store(descriptor_);
  return error;
}

int NewFile::sync() const { return ::fsync(descriptor_) == 0 ? 0 : errno; }

int NewFile::rename_to(const std::string& target) {
  held_.begin();
  if (name_.empty()) {
    const std::string self = link_source();
    const int error = with_free_name(folder_, name_, [&](const std::string& name) {
      return ::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
    });
    if (error != 0) {
      return error;
    }
  }
  if (::rename(name_.c_str(), target.c_str()) != 0) {
    return errno;
  }
  let_go();
  return 0;
}

}  // namespace tenon::bytes
