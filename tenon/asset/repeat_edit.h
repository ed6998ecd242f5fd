// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/diagnostics.h"
#include "tenon/bytes/read_record.h"

namespace tenon {

/// For edits of files: repeats `work`, which gives a Result, as long as it fails because somebody
/// else has changed a file that was read, so that no edit is lost. Findings of a failed attempt are
/// removed from `diagnostics`.
template <class Work>
auto repeat_edit(Diagnostics& diagnostics, Work work) {
  constexpr int kAttempts = 100;
  const Diagnostics before = diagnostics;
  bytes::ReadRecord* record = bytes::ReadRecord::current();
  if (record != nullptr) {
    record->keep_digests();
  }
  auto done = work();
  for (int i = 1; i < kAttempts && !done && bytes::is_changed_meanwhile(done.error()); ++i) {
    if (record != nullptr) {
      record->clear();
    }
    diagnostics = before;
    done = work();
  }
  return done;
}

}  // namespace tenon
