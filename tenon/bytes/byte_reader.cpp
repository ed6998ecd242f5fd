// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/byte_reader.h"

namespace tenon::bytes {

Error out_of_bounds(std::uint64_t offset, std::uint64_t wanted, std::uint64_t size) {
  return Error(ErrorCode::Corrupt, "the file ends too early: it has " + std::to_string(size) +
                                       " bytes, and " + std::to_string(wanted) +
                                       " are expected at offset " + std::to_string(offset))
      .with_rule("file.truncated");
}

}  // namespace tenon::bytes
