// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>

#include "tenon/asset/made_file.h"
#include "tenon/base/result.h"
#include "tenon/bytes/read_record.h"
#include "tenon/stage/stage.h"

namespace tenon::python {

/// While one lives, files that are read are noted, and none of them is written over. One at a time
/// in the process: the next one waits. The interpreter must not be held where one is made.
class GuardedRun {
 public:
  GuardedRun();
  ~GuardedRun();
  GuardedRun(const GuardedRun&) = delete;
  GuardedRun& operator=(const GuardedRun&) = delete;
  /// The layers of a stage count as read.
  void note(const stage::Stage& stage);

 private:
  std::unique_lock<std::mutex> alone_;
};

/// Writes files that were made, all or none. Errors: those of bytes::FileTransaction.
Result<void> write_made(const MadeFiles& files);

}  // namespace tenon::python
