// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/atomic_write.h"

#include <array>
#include <climits>
#include <optional>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tenon/bytes/posix_files.h"

namespace tenon::bytes {
namespace {

constexpr int kLinks = 40;  // links that lead to links

Error refused(const std::string& path, const std::string& why, const std::string& fix) {
  return Error(ErrorCode::Io, "cannot write the file: " + why)
      .in_file(path)
      .with_rule("file.unwritable")
      .with_fix(fix);
}

/// What links lead to, whether it exists or not.
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

/// A file in the making. It has no name at first where the file system knows such files, so that
/// nothing is left when the process ends early.
class NewFile {
 public:
  explicit NewFile(std::string folder) : folder_(std::move(folder)) {}
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile() {
    if (descriptor_ >= 0) {
      ::close(descriptor_);
    }
    if (!name_.empty()) {
      ::unlink(name_.c_str());
    }
  }

  int open() {
#ifdef O_TMPFILE
    const char* where = folder_.empty() ? "." : folder_.c_str();
    if (::access("/proc/self/fd", X_OK) == 0) {  // through which the file will get its name
      descriptor_ = ::open(where, O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    }
    if (descriptor_ >= 0) {
      return 0;
    }
#endif
    return open_with_name();
  }

  /// Owner and permissions of the file that is replaced. That the owner may not be changed is no
  /// error.
  int take_over(const struct stat& old) {
    struct stat own = {};
    if (::fstat(descriptor_, &own) == 0 && (own.st_uid != old.st_uid || own.st_gid != old.st_gid) &&
        ::fchown(descriptor_, old.st_uid, old.st_gid) != 0) {
      errno = 0;
    }
    return ::fchmod(descriptor_, old.st_mode & 07777u) == 0 ? 0 : errno;
  }

  int write(std::string_view contents) {
    const int error = write_all(descriptor_, contents);
    if (error != 0) {
      return error;
    }
    return ::fsync(descriptor_) == 0 ? 0 : errno;
  }

  int rename_to(const std::string& target) {
    if (name_.empty()) {
      const std::string self = "/proc/self/fd/" + std::to_string(descriptor_);
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
    name_.clear();
    return 0;
  }

 private:
  int open_with_name() {
    return with_free_name(folder_, name_, [&](const std::string& name) {
      descriptor_ = ::open(name.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
      return descriptor_ >= 0;
    });
  }

  std::string folder_;  // with '/' at the end, or empty
  std::string name_;    // while it has a hidden one
  int descriptor_ = -1;
};

Result<void> write_directly(const std::string& path, std::string_view contents) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) {
    return unwritable(path, "file", errno);
  }
  int error = write_all(descriptor, contents);
  if (::close(descriptor) != 0 && error == 0) {
    error = errno;
  }
  return error == 0 ? Result<void>() : Result<void>(unwritable(path, "file", error));
}

}  // namespace

Result<void> write_file(const std::string& path, std::string_view contents) {
  const std::string target = follow_links(path);
  std::optional<struct stat> old(std::in_place);
  if (::stat(target.c_str(), &*old) != 0) {
    old.reset();
  }
  if (old && S_ISDIR(old->st_mode)) {
    return refused(path, "it is a folder", "name a file in it");
  }
  if (old && !S_ISREG(old->st_mode)) {
    return write_directly(target, contents);
  }
  if (old && ((old->st_mode & 0222u) == 0 || ::access(target.c_str(), W_OK) != 0)) {
    return refused(path, "it is read-only", "allow writing (chmod u+w), or write elsewhere");
  }
  const std::string folder = target.substr(0, target.rfind('/') + 1);
  NewFile file(folder);
  int error = file.open();
  if (error == 0 && old) {
    error = file.take_over(*old);
  }
  if (error == 0) {
    error = file.write(contents);
  }
  if (error == 0) {
    error = file.rename_to(target);
  }
  if (error != 0) {
    return unwritable(path, "file", error);
  }
  sync_folder(folder.empty() ? "." : folder);  // that it may be lost in a power cut is no error
  return {};
}

}  // namespace tenon::bytes
