// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tenon/bytes/read_record.h"

namespace tenon::live {

/// Whether files are still what they were. Asks the disk at each look, which works on every file
/// system and costs a few microseconds for each file.
class FileWatch {
 public:
  /// From now on these, as they are now.
  void begin(const std::vector<std::string>& paths);
  /// True when a file has changed since begin(), came or went, and all have been the same at two
  /// looks: an editor may need a moment for all of them. Then they are watched as they are now.
  bool look();
  /// One of them may have changed before begin() came to it: as if it had changed now.
  void doubt() { changed_before_ = true; }

 private:
  using Stamps = std::map<std::string, std::optional<bytes::FileStamp>>;
  static bool same(const Stamps& a, const Stamps& b);
  Stamps stamps_now() const;

  Stamps known_;
  bool changed_before_ = false;
  std::optional<Stamps> changed_;  // what the last look has found, where it was something else
};

}  // namespace tenon::live
