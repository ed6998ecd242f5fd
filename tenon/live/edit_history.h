// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tenon/asset/edited_file.h"
#include "tenon/base/function.h"
#include "tenon/base/result.h"
#include "tenon/bytes/files.h"

namespace tenon::live {

/// Writes edits of files, all or none (tenon::write_files, or what stands before it).
using WriteFiles = Function<Result<void>(const std::vector<EditedFile>& files)>;

/// Edits of files that were written, byte by byte, so that each can be taken back and made again
/// as long as no one else has changed its files.
class EditHistory {
 public:
  /// Keeps the bytes that the files have, lets `write` write the edits, and keeps what they have
  /// then. What was taken back before is forgotten. Errors: those of `write`; then nothing is kept.
  Result<void> make(const std::vector<EditedFile>& files, const bytes::Files& from,
                    const WriteFiles& write);
  /// Errors: NotFound (live.nothing-to-undo), Invalid (live.file-changed) where a file is no longer
  /// what the edit made of it; those of `write`.
  Result<void> undo(const bytes::Files& from, const WriteFiles& write);
  Result<void> redo(const bytes::Files& from, const WriteFiles& write);

  bool can_undo() const { return made_ > 0; }
  bool can_redo() const { return made_ < steps_.size(); }

 private:
  /// None: there is no such file.
  using Contents = std::optional<std::string>;
  struct Change {
    std::string path;
    Contents before;
    Contents after;
  };
  using Step = std::vector<Change>;

  static Result<Contents> read(const std::string& path, const bytes::Files& from);
  static Result<void> apply(const Step& step, bool back, const bytes::Files& from,
                            const WriteFiles& write);

  std::vector<Step> steps_;
  std::size_t made_ = 0;  // those behind it were taken back
};

}  // namespace tenon::live
