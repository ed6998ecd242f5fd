// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "tenon/base/function.h"
#include "tenon/base/result.h"

namespace tenon::bytes {

/// What files may be opened and how.
struct FileRules {
  /// Asked about the file that is open, by its path without symbolic links, before it is read.
  Function<Result<void>(const std::string& real_path)> check;
  bool may_map = true;  ///< false: large files are read, too
  /// False for a file that is read only to be replaced: it is noted in no ReadRecord.
  bool is_input = true;
  std::uint64_t max_bytes = UINT64_MAX;  ///< of the file; for more ErrorCode::Limit
};

/// ErrorCode::Limit, rule "file.too-large", for a file of more bytes than the rules allow.
Result<void> check_size(std::uint64_t bytes, const FileRules& rules, const std::string& path);

/// The bytes of a file or a part of one, read-only and shared by all who read from them.
class FileBytes {
 public:
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;
  ~FileBytes();

  /// All of the file at `path` on the disk: mapped when large, read when small. What reads assets
  /// asks a Files instead (files.h). ErrorCode::NotFound when there is none, Io when it cannot be
  /// read. A mapped file must not be shortened while it is in use,
  /// which ends the program (SIGBUS); replacing it (atomic_write.h) is fine.
  static Result<std::shared_ptr<const FileBytes>> open(const std::string& path,
                                                       const FileRules& rules = {});
  /// Bytes made in memory.
  static std::shared_ptr<const FileBytes> own(std::string contents);
  /// `size` bytes of `whole` from `offset`, which keep it alive. The range must lie inside.
  static std::shared_ptr<const FileBytes> slice(std::shared_ptr<const FileBytes> whole,
                                                std::size_t offset, std::size_t size);

  std::span<const std::byte> span() const { return span_; }
  std::string_view text() const {
    return {reinterpret_cast<const char*>(span_.data()), span_.size()};
  }
  std::size_t size() const { return span_.size(); }

  /// A part of these bytes will hardly be used again: where it was mapped, its memory goes back to
  /// the system, and is read from the file again when needed.
  void let_go(std::span<const std::byte> part) const;

 private:
  FileBytes() = default;

  std::string owned_;
  std::shared_ptr<const FileBytes> whole_;
  void* mapping_ = nullptr;  // with span_.size() bytes, else nullptr
  std::span<const std::byte> span_;
};

}  // namespace tenon::bytes
