// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/replace_files.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <utility>
#include <vector>

#include <unistd.h>

#include "tenon/bytes/atomic_write.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/bytes/new_folder.h"
#include "tenon/bytes/posix_files.h"

namespace tenon::bytes {
namespace {

namespace fs = std::filesystem;
using Contents = std::map<std::string, std::string>;

constexpr std::size_t kEntries = 100000;  // of a folder that is made again

/// The folder that holds them all; "/" and what stands right below it are nobody's asset.
fs::path common_folder(const Contents& files) {
  fs::path common = fs::path(files.begin()->first).parent_path();
  for (const auto& [path, contents] : files) {
    while (common.has_relative_path() && !path.starts_with(common.string() + "/")) {
      common = common.parent_path();
    }
  }
  return common.parent_path().has_relative_path() ? common : fs::path();
}

/// A folder as it is to be: links to its files, and the new ones.
class Copy {
 public:
  Copy(fs::path folder, const Contents& files, NewFolder& made)
      : folder_(std::move(folder)), files_(files), made_(made) {}

  /// 0 or an error number.
  int run() {
    std::error_code error;
    fs::recursive_directory_iterator at(folder_, error);
    for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
      if (++count_ > kEntries) {
        return EMLINK;
      }
      if (const int number = add(*at); number != 0) {
        return number;
      }
    }
    return error ? error.value() : take_over(folder_, "");
  }

 private:
  /// Folders get their permissions, which may be none to write, once they are full.
  int take_over(const fs::path& old, const std::string& name) {
    folders_.emplace_back(old, name);
    for (auto folder = folders_.rbegin(); folder != folders_.rend(); ++folder) {
      if (const int number = made_.take_mode(folder->second, folder->first.string()); number != 0) {
        return number;
      }
    }
    return 0;
  }

  int add(const fs::directory_entry& entry) {
    const std::string name = entry.path().lexically_relative(folder_).generic_string();
    std::error_code error;
    if (entry.is_symlink(error)) {
      return made_.add_link(name, fs::read_symlink(entry.path(), error).string());
    }
    if (entry.is_directory(error)) {
      folders_.emplace_back(entry.path(), name);
      return made_.add_folder(name) ? 0 : EIO;
    }
    if (!entry.is_regular_file(error)) {
      return ENOTSUP;
    }
    const auto file = files_.find(entry.path().string());
    if (file == files_.end()) {
      return made_.add_hard_link(name, entry.path().string());
    }
    if (!made_.add_file(name, file->second)) {
      return EIO;
    }
    return made_.take_mode(name, entry.path().string());
  }

  fs::path folder_;
  const Contents& files_;
  NewFolder& made_;
  std::vector<std::pair<fs::path, std::string>> folders_;
  std::size_t count_ = 0;
};

/// False where it cannot be done so, and nothing has happened.
bool exchange_folder(const Contents& files) {
  const fs::path folder = common_folder(files);
  const bool writable = std::all_of(files.begin(), files.end(), [](const auto& file) {
    std::error_code error;
    const auto mode = fs::status(file.first, error).permissions();
    constexpr auto kWrite =
        fs::perms::owner_write | fs::perms::group_write | fs::perms::others_write;
    return (mode & kWrite) != fs::perms::none && ::access(file.first.c_str(), W_OK) == 0 &&
           ::access(fs::path(file.first).parent_path().c_str(), W_OK) == 0;
  });
  if (folder.empty() || !writable) {
    return false;
  }
  auto made = NewFolder::beside(folder.string());
  return made && Copy(folder, files, *made).run() == 0 &&
         made->take_place(NewFolder::Replace::Anything).has_value();
}

Result<void> replace_in_turn(const Contents& files) {
  Contents old;
  for (const auto& [path, contents] : files) {
    TENON_TRY(const auto before, FileBytes::open(path));
    old.emplace(path, std::string(before->text()));
    if (auto written = write_file(path, contents); !written) {
      old.erase(path);
      for (const auto& [done, text] : old) {
        (void)write_file(done, text);
      }
      return written;
    }
  }
  return {};
}

}  // namespace

Result<void> replace_files(const Contents& contents_by_path) {
  Contents files;  // by what links lead to
  for (const auto& [path, contents] : contents_by_path) {
    std::error_code error;
    const fs::path target = fs::canonical(path, error);
    if (error) {
      return unwritable(path, "file", error.value());
    }
    files.insert_or_assign(target.string(), contents);
  }
  if (files.size() > 1 && exchange_folder(files)) {
    return {};
  }
  return replace_in_turn(files);
}

}  // namespace tenon::bytes
