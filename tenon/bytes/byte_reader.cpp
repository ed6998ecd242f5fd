// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/byte_reader.h"

namespace tenon::bytes {

Error out_of_bounds(std::uint64_t offset, std::uint64_t wanted, std::uint64_t size) {
  return Error(ErrorCode::Corrupt, "data of " + std::to_string(wanted) + " at offset " +
                                       std::to_string(offset) + " leave the file of " +
                                       std::to_string(size) + " bytes")
      .with_rule("file.truncated");
}

}  // namespace tenon::bytes
