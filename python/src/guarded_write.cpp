// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "guarded_write.h"

#include "tenon/bytes/write/file_transaction.h"
#include "tenon/layer/layer.h"

namespace tenon::python {
namespace {

std::mutex& one_at_a_time() {
  static std::mutex mutex;
  return mutex;
}

/// Never destroyed: another thread that opens files meanwhile may still note one in it.
bytes::ReadRecord& record() {
  static auto* kept = new bytes::ReadRecord();
  return *kept;
}

}  // namespace

GuardedRun::GuardedRun() : alone_(one_at_a_time()) { record().install(); }

GuardedRun::~GuardedRun() {
  record().uninstall();
  record().clear();
}

void GuardedRun::note(const stage::Stage& stage) {
  for (const layer::LayerPtr& used : stage.used_layers()) {
    record().note(used->identifier());
  }
}

Result<void> write_made(const MadeFiles& files) {
  bytes::FileTransaction transaction;
  for (const MadeFile& file : files) {
    transaction.put(file.path, file.contents);
  }
  return transaction.commit({.make_folders = true});
}

}  // namespace tenon::python
