// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The folder grows under a hidden name beside its place. Files are synced, then folders, and one
// rename gives it the place, so nobody sees half of it there. The maker locks the folder, and the
// system drops the lock when the process ends. The next maker in the same parent can therefore tell
// what a killed program left: it removes the hidden folders of its own user that it can lock.
#include "tenon/bytes/write/new_folder.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tenon/bytes/posix_files.h"

namespace tenon::bytes {
namespace {

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

std::string parent_of(const std::string& path) { return path.substr(0, path.rfind('/') + 1); }

/// An exclusive lock on a folder; -1 where another process has it, or where there are no locks.
int lock_of(const std::string& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor >= 0 && ::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    ::close(descriptor);
    return -1;
  }
  return descriptor;
}

bool is_hidden_name(std::string_view name) {
  constexpr std::string_view kStart = ".tenon-";
  return name.starts_with(kStart) && name.size() > kStart.size() &&
         name.find_first_not_of("0123456789-", kStart.size()) == std::string_view::npos;
}

/// Takes folders away that were in the making when their programs were killed.
void sweep(const std::string& parent) {
  std::error_code error;
  std::filesystem::directory_iterator at(parent.empty() ? "." : parent, error);
  for (; !error && at != std::filesystem::directory_iterator(); at.increment(error)) {
    struct stat info = {};
    if (!is_hidden_name(at->path().filename().native()) ||
        ::lstat(at->path().c_str(), &info) != 0 || !S_ISDIR(info.st_mode) ||
        info.st_uid != ::geteuid()) {
      continue;
    }
    if (const int lock = lock_of(at->path().string()); lock >= 0) {
      std::error_code ignored;
      std::filesystem::remove_all(at->path(), ignored);
      ::close(lock);
    }
  }
}

}  // namespace

Result<NewFolder> NewFolder::beside(const std::string& place) {
  NewFolder made(place);
  made.held_.begin();
  sweep(parent_of(place));
  constexpr int kNames = 10;  // another program may sweep the folder away before it is locked
  for (int i = 0; i < kNames && (i == 0 || ::access(made.path_.c_str(), F_OK) != 0); ++i) {
    const int error = with_free_name(parent_of(place), made.path_, [](const std::string& name) {
      return ::mkdir(name.c_str(), 0777) == 0;
    });
    if (error != 0) {
      return unwritable(place, "folder", error);
    }
    if (made.lock_ >= 0) {
      ::close(made.lock_);
    }
    made.lock_ = lock_of(made.path_);
  }
  made.folders_.insert(made.path_);
  return made;
}

NewFolder::NewFolder(NewFolder&& other) noexcept
    : place_(std::move(other.place_)),
      path_(std::exchange(other.path_, {})),
      held_(std::move(other.held_)),
      lock_(std::exchange(other.lock_, -1)),
      folders_(std::move(other.folders_)),
      files_(std::move(other.files_)) {}

NewFolder::~NewFolder() {
  if (lock_ >= 0) {
    ::close(lock_);
  }
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
  int error = is_asked_to_end() ? EINTR : make_folders(parent_of(name));
  files_.push_back(path_ + "/" + name);
  error = error != 0 ? error : write_new_file(files_.back(), contents);
  return error == 0 ? Result<void>() : unwritable(place_ + "/" + name, "file", error);
}

int NewFolder::sync_and_rename() {
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
  if (::rename(path_.c_str(), place_.c_str()) != 0) {
    return errno;
  }
  path_.clear();
  return 0;
}

Result<void> NewFolder::take_place() {
  const int error = sync_and_rename();
  if (error == ENOTEMPTY || error == EEXIST || error == ENOTDIR) {
    return Error(ErrorCode::Io, "the folder holds something already")
        .in_file(place_)
        .with_rule("file.exists")
        .with_fix("name a folder that does not exist yet");
  }
  if (error != 0) {
    return unwritable(place_, "folder", error);
  }
  sync_folder(parent_of(place_));  // that it may be lost in a power cut is no error
  return {};
}

}  // namespace tenon::bytes
