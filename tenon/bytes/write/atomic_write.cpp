// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/write/atomic_write.h"

#include "tenon/bytes/write/file_transaction.h"

namespace tenon::bytes {

Result<void> write_file(const std::string& path, std::string_view contents) {
  FileTransaction transaction;
  transaction.put(path, contents);
  return transaction.commit();
}

}  // namespace tenon::bytes
