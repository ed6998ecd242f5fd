// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <set>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "tenon/structure/layout.h"
#include "tenon/structure/package.h"

namespace tenon::structure {
namespace {

namespace fs = std::filesystem;

constexpr int kNames = 100;         // hidden names tried
constexpr unsigned kNoReplace = 1;  // RENAME_NOREPLACE and RENAME_EXCHANGE of <linux/fs.h>,
constexpr unsigned kExchange = 2;   // which C libraries name from different headers

Error folder_error(const std::string& folder, int number) {
  const bool full = number == ENOSPC || number == EDQUOT || number == EFBIG;
  return Error(ErrorCode::Io, std::string("cannot write the folder: ") + std::strerror(number))
      .in_file(folder)
      .with_rule("file.unwritable")
      .with_fix(full ? "make room, or write to another disk"
                     : "name a folder whose parent exists and may be written to");
}

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
  return 0;
}

/// 0 or the error number. The file must not exist.
int write_new_file(const std::string& path, std::string_view contents) {
  const int descriptor = ::open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    return errno;
  }
  int error = write_all(descriptor, contents);
  if (error == 0 && ::fsync(descriptor) != 0) {
    error = errno;
  }
  ::close(descriptor);
  return error;
}

int sync_folder(const std::string& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) {
    return errno;
  }
  const int error = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  return error;
}

int rename_with(const std::string& from, const std::string& to, unsigned flags) {
  const long done = ::syscall(SYS_renameat2, AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flags);
  return done == 0 ? 0 : errno;
}

/// A folder in the making, under a hidden name beside its place; gone with the object.
class NewFolder {
 public:
  explicit NewFolder(std::string parent) : parent_(std::move(parent)) {}
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  ~NewFolder() {
    if (!path_.empty()) {
      std::error_code ignored;
      fs::remove_all(path_, ignored);
    }
  }

  int make() {
    static std::atomic<unsigned> counter{0};
    for (int i = 0; i < kNames; ++i) {
      path_ = parent_ + "/.tenon-" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
      if (::mkdir(path_.c_str(), 0777) == 0) {
        return 0;
      }
      const int error = errno;
      path_.clear();
      if (error != EEXIST) {
        return error;
      }
    }
    return EEXIST;
  }

  int fill(const std::map<std::string, std::string>& files) {
    std::set<std::string> folders{path_};
    for (const auto& [name, contents] : files) {
      std::string folder = path_;
      for (std::size_t at = 0, slash = name.find('/'); slash != std::string::npos;
           at = slash + 1, slash = name.find('/', at)) {
        folder += '/';
        folder += name.substr(at, slash - at);
        if (folders.insert(folder).second && ::mkdir(folder.c_str(), 0777) != 0) {
          return errno;
        }
      }
      if (const int error = write_new_file(path_ + "/" + name, contents); error != 0) {
        return error;
      }
    }
    for (const std::string& folder : folders) {
      if (const int error = sync_folder(folder); error != 0) {
        return error;
      }
    }
    return 0;
  }

  /// What stood there before has the hidden name then.
  int take_place(const std::string& folder, bool exists) {
    const int error = rename_with(path_, folder, exists ? kExchange : kNoReplace);
    if (error == 0 && !exists) {
      path_.clear();
    }
    return error;
  }

 private:
  std::string parent_;
  std::string path_;
};

bool is_known_place(const std::string& name) {
  if (name.starts_with("Textures/") || name.starts_with("Materials/")) {
    return true;
  }
  return role_of_file_name(name) != Role::Other;
}

Result<void> check_replaceable(const std::string& folder) {
  const std::vector<std::string> foreign = foreign_files(folder);
  if (foreign.empty()) {
    return {};
  }
  return Error(ErrorCode::Invalid, "the folder holds files that are no part of an asset, \"" +
                                       foreign.front() +
                                       "\" among them; they would go with what it is replaced by")
      .in_file(folder)
      .with_fix("name a new folder, or move those files elsewhere");
}

bool is_usable_name(const std::string& name) {
  const fs::path path(name);
  return !name.empty() && path.is_relative() && path.lexically_normal() == path &&
         *path.begin() != ".." && path.has_filename();
}

}  // namespace

std::vector<std::string> foreign_files(const std::string& folder) {
  std::vector<std::string> found;
  std::error_code error;
  fs::recursive_directory_iterator at(folder, error);
  for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
    std::error_code ignored;
    if (at->is_directory(ignored) && !at->is_symlink(ignored)) {
      continue;
    }
    std::string name = at->path().lexically_relative(folder).generic_string();
    if (!is_known_place(name)) {
      found.push_back(std::move(name));
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

Result<void> write_folder(const std::map<std::string, std::string>& files,
                          const std::string& folder) {
  for (const auto& [name, contents] : files) {
    if (!is_usable_name(name)) {
      return Error(ErrorCode::Invalid, "\"" + name + "\" is no name of a file in a folder")
          .in_file(folder);
    }
  }
  std::error_code error;
  const bool exists = fs::exists(folder, error);
  fs::path target = exists ? fs::canonical(folder, error) : fs::absolute(folder, error);
  if (error) {
    return folder_error(folder, error.value());
  }
  target = target.lexically_normal();
  target = target.has_filename() ? target : target.parent_path();
  if (exists && !fs::is_directory(target, error)) {
    return folder_error(folder, ENOTDIR);
  }
  TENON_CHECK(check_replaceable(exists ? target.string() : ""));
  NewFolder made(target.parent_path().string());
  int number = made.make();
  number = number != 0 ? number : made.fill(files);
  if (number == 0) {
    number = made.take_place(target.string(), exists);
    if (exists && (number == EINVAL || number == ENOSYS || number == EXDEV)) {
      return Error(ErrorCode::Unsupported, "the file system cannot exchange folders in one step")
          .in_file(folder)
          .with_fix("write to a new folder, or remove this one first");
    }
  }
  if (number != 0) {
    return folder_error(folder, number);
  }
  sync_folder(target.parent_path().string());  // that it may be lost in a power cut is no error
  return {};
}

}  // namespace tenon::structure
