// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/new_folder.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "tenon/bytes/posix_files.h"

namespace tenon::bytes {
namespace {

constexpr unsigned kExchange = 2;  // RENAME_EXCHANGE, which C libraries name in different headers

/// Has the system begin to write a file to its disk, so that syncing many files one after another
/// is done in little more than the time for one. That it cannot is no error: they are synced later.
void begin_to_store(int descriptor) {
#ifdef SYNC_FILE_RANGE_WRITE
  ::sync_file_range(descriptor, 0, 0, SYNC_FILE_RANGE_WRITE);
#endif
}

/// The file must not exist.
int write_new_file(const std::string& path, std::string_view contents) {
  const int descriptor = ::open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    return errno;
  }
  const int error = write_all(descriptor, contents);
  begin_to_store(descriptor);
  return ::close(descriptor) == 0 ? error : errno;
}

int exchange_names(const std::string& a, const std::string& b) {
  const long done = ::syscall(SYS_renameat2, AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), kExchange);
  return done == 0 ? 0 : errno;
}

std::string parent_of(const std::string& path) { return path.substr(0, path.rfind('/') + 1); }

}  // namespace

Result<NewFolder> NewFolder::beside(const std::string& place) {
  NewFolder made(place);
  const int error = with_free_name(parent_of(place), made.path_, [](const std::string& name) {
    return ::mkdir(name.c_str(), 0777) == 0;
  });
  if (error != 0) {
    return unwritable(place, "folder", error);
  }
  made.folders_.insert(made.path_);
  return made;
}

NewFolder::NewFolder(NewFolder&& other) noexcept
    : place_(std::move(other.place_)),
      path_(std::exchange(other.path_, {})),
      folders_(std::move(other.folders_)),
      files_(std::move(other.files_)) {}

NewFolder::~NewFolder() {
  if (!path_.empty()) {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
}

/// Makes the folder of that name and those above it.
int NewFolder::make_folders(const std::string& name) {
  for (std::size_t at = 0; at < name.size();) {
    const std::size_t end = std::min(name.find('/', at), name.size());
    const std::string folder = path_ + "/" + name.substr(0, end);
    if (folders_.insert(folder).second && ::mkdir(folder.c_str(), 0777) != 0) {
      return errno;
    }
    at = end + 1;
  }
  return 0;
}

Result<void> NewFolder::add_folder(const std::string& name) {
  const int error = make_folders(name);
  return error == 0 ? Result<void>() : unwritable(place_ + "/" + name, "folder", error);
}

Result<void> NewFolder::add_file(const std::string& name, std::string_view contents) {
  int error = make_folders(parent_of(name));
  files_.push_back(path_ + "/" + name);
  error = error != 0 ? error : write_new_file(files_.back(), contents);
  return error == 0 ? Result<void>() : unwritable(place_ + "/" + name, "file", error);
}

int NewFolder::add_link(const std::string& name, const std::string& target) {
  const int error = make_folders(parent_of(name));
  return error == 0 && ::symlink(target.c_str(), (path_ + "/" + name).c_str()) != 0 ? errno : error;
}

int NewFolder::add_hard_link(const std::string& name, const std::string& existing) {
  const int error = make_folders(parent_of(name));
  return error == 0 && ::link(existing.c_str(), (path_ + "/" + name).c_str()) != 0 ? errno : error;
}

/// That the owner may not be changed is no error.
int NewFolder::take_mode(const std::string& name, const std::string& existing) {
  const std::string path = name.empty() ? path_ : path_ + "/" + name;
  struct stat old = {};
  struct stat own = {};
  if (::stat(existing.c_str(), &old) != 0 || ::stat(path.c_str(), &own) != 0) {
    return errno;
  }
  if ((own.st_uid != old.st_uid || own.st_gid != old.st_gid) &&
      ::chown(path.c_str(), old.st_uid, old.st_gid) != 0) {
    errno = 0;
  }
  return ::chmod(path.c_str(), old.st_mode & 07777u) == 0 ? 0 : errno;
}

int NewFolder::sync_and_rename(Replace replace) {
  for (const std::string& file : files_) {
    if (const int error = sync_file(file); error != 0) {
      return error;
    }
  }
  for (const std::string& folder : folders_) {
    if (const int error = sync_folder(folder); error != 0) {
      return error;
    }
  }
  // An empty folder may be replaced by renaming, which all file systems can.
  if (::rename(path_.c_str(), place_.c_str()) == 0) {
    path_.clear();
    return 0;
  }
  if (replace == Replace::Anything && (errno == ENOTEMPTY || errno == EEXIST)) {
    return exchange_names(path_, place_);  // what stood there goes under the hidden name
  }
  return errno;
}

Result<void> NewFolder::take_place(Replace replace) {
  const int error = sync_and_rename(replace);
  if (error == EINVAL || error == ENOSYS || error == EXDEV) {
    return Error(ErrorCode::Unsupported, "the file system cannot exchange folders in one step")
        .in_file(place_)
        .with_fix("write to a new folder, or remove this one first");
  }
  if (error != 0) {
    return unwritable(place_, "folder", error);
  }
  sync_folder(parent_of(place_));  // that it may be lost in a power cut is no error
  return {};
}

}  // namespace tenon::bytes
