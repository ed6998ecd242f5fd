// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/live/edit_history.h"

#include <utility>

#include "tenon/base/text/shown_path.h"

namespace tenon::live {

Result<EditHistory::Contents> EditHistory::read(const std::string& path, const bytes::Files& from) {
  if (from->kind(path) == bytes::NameKind::Nothing) {
    return Contents();
  }
  TENON_TRY(const auto file, from->open(path, {}));
  return Contents(std::string(file->text()));
}

Result<void> EditHistory::make(const std::vector<EditedFile>& files, const bytes::Files& from,
                               const WriteFiles& write) {
  Step step;
  for (const EditedFile& file : files) {
    TENON_TRY(Contents before, read(file.path, from));
    step.push_back(
        {file.path, std::move(before), file.removed ? Contents() : Contents(file.after)});
  }
  TENON_CHECK(write(files));
  steps_.resize(made_);
  steps_.push_back(std::move(step));
  ++made_;
  return {};
}

Result<void> EditHistory::apply(const Step& step, bool back, const bytes::Files& from,
                                const WriteFiles& write) {
  std::vector<EditedFile> files;
  for (const Change& change : step) {
    const Contents& wanted = back ? change.before : change.after;
    const Contents& expected = back ? change.after : change.before;
    TENON_TRY(const Contents now, read(change.path, from));
    if (now != expected) {
      return Error(ErrorCode::Invalid,
                   "`" + shown_path(change.path) +
                       "` was changed by somebody else since; it stays as it is")
          .in_file(change.path)
          .with_rule("live.file-changed")
          .with_fix("set the value again by hand");
    }
    EditedFile file;
    file.path = change.path;
    file.before = now.value_or("");
    file.after = wanted.value_or("");
    file.removed = !wanted.has_value();
    files.push_back(std::move(file));
  }
  return write(files);
}

Result<void> EditHistory::undo(const bytes::Files& from, const WriteFiles& write) {
  if (!can_undo()) {
    return Error(ErrorCode::NotFound, "there is no edit to take back")
        .with_rule("live.nothing-to-undo");
  }
  TENON_CHECK(apply(steps_[made_ - 1], true, from, write));
  --made_;
  return {};
}

Result<void> EditHistory::redo(const bytes::Files& from, const WriteFiles& write) {
  if (!can_redo()) {
    return Error(ErrorCode::NotFound, "there is no edit to make again")
        .with_rule("live.nothing-to-undo");
  }
  TENON_CHECK(apply(steps_[made_], false, from, write));
  ++made_;
  return {};
}

}  // namespace tenon::live
