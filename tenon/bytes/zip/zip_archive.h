// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/bytes/file_bytes.h"

/// Zip files as USD packages use them: stored entries only, data at multiples of 64 bytes.
namespace tenon::bytes {

struct ZipEntry {
  std::string name;          ///< with '/' between folders
  std::uint64_t header = 0;  ///< offset of the local header
  std::uint64_t size = 0;    ///< bytes of the data as they lie in the file
  std::uint64_t end = 0;     ///< offset that the data must not reach beyond: what comes next
  std::uint32_t crc = 0;     ///< CRC-32 of the contents
  std::uint16_t method = 0;  ///< 0: stored
  bool encrypted = false;
};

/// The table of contents of a zip file in the order of the data; the data stay where they are.
class ZipArchive {
 public:
  /// True for bytes that begin as a zip file does.
  static bool is_zip(std::string_view bytes);
  /// Errors: Corrupt "package.damaged" for a table of contents that does not fit the file, where
  /// entries lie over one another, or where a name stands twice.
  static Result<ZipArchive> open(std::shared_ptr<const FileBytes> bytes);

  const std::vector<ZipEntry>& entries() const { return entries_; }
  /// nullptr when no entry has that name.
  const ZipEntry* find(std::string_view name) const;
  /// ErrorCode::Unsupported for compressed and encrypted entries; Corrupt "package.damaged" where
  /// the entry's own header says something else than the table of contents, and for contents of up
  /// to kCheckedEntryBytes that are not those of the check sum.
  Result<std::shared_ptr<const FileBytes>> read(const ZipEntry& entry) const;
  /// The same with the check sum of contents of any size.
  Result<std::shared_ptr<const FileBytes>> read_checked(const ZipEntry& entry) const;

 private:
  Result<void> check_order(std::uint64_t directory);
  Result<std::shared_ptr<const FileBytes>> contents_of(const ZipEntry& entry) const;

  std::shared_ptr<const FileBytes> bytes_;
  std::vector<ZipEntry> entries_;
};

/// One file of a package to be written.
struct ZipFile {
  std::string name;
  std::string_view contents;
};

/// A zip file with `files` in their order, stored, each at a multiple of 64 bytes; the same bytes
/// for the same input. Errors: more than 4 GiB, names twice, empty or longer than 65535 bytes.
Result<std::string> write_zip(const std::vector<ZipFile>& files);

}  // namespace tenon::bytes
