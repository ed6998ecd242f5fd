// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include <sys/stat.h>

#include "tenon/bytes/write/held_signals.h"

/// A file in the making, for those who put files in their places. Functions return 0 or an error
/// number.
namespace tenon::bytes {

/// What links lead to, whether it exists or not.
std::string follow_links(std::string path);

/// A file in the making, in the folder of its place. It has no name at first where the file system
/// knows such files, so that nothing is left when the process ends early; else a hidden one, which
/// signals that ask the process to end wait for.
class NewFile {
 public:
  enum class Name : bool { None, Hidden };

  /// `folder` ends with '/', or is empty: the current one.
  explicit NewFile(std::string folder) : folder_(std::move(folder)) {}
  NewFile(NewFile&& other) noexcept;
  NewFile& operator=(NewFile&&) = delete;
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile();

  /// With a hidden name where the caller wants that (many open files at once) or nothing else goes.
  int open(Name name = Name::None);
  /// Owner and permissions of the file that is replaced. That the owner may not be changed is no
  /// error.
  int take_over(const struct stat& old);
  int write(std::string_view contents);
  /// Waits until the disk has it.
  int sync() const;
  /// Lets go of the open file, which needs a hidden name to be found again.
  void close();
  int rename_to(const std::string& target);

  int descriptor() const { return descriptor_; }
  /// "" while it has none.
  const std::string& name() const { return name_; }
  /// Where a file without a name can be linked from, by this process and its children.
  std::string link_source() const { return "/proc/self/fd/" + std::to_string(descriptor_); }
  /// From now on another owner removes the name.
  void let_go() {
    name_.clear();
    held_.end();
  }

 private:
  std::string folder_;
  HeldSignals held_;  // while it has a hidden name
  std::string name_;
  int descriptor_ = -1;
};

}  // namespace tenon::bytes
