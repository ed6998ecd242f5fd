// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tenon/base/error.h"
#include "tenon/base/limits/limits.h"
#include "tenon/base/result.h"

namespace tenon::formats::crate {

/// How much may be made out of a file of a given size, so that a small file which names the same
/// data over and over cannot fill the memory.
class WorkBudget {
 public:
  explicit WorkBudget(std::uint64_t file_size)
      : left_(file_size * limits::kCrateWorkPerByte + limits::kCrateWorkBase) {}

  /// Takes `amount` units (elements, fields) off; ErrorCode::Limit when none are left.
  Result<void> spend(std::uint64_t amount) {
    if (amount > left_) {
      return Error(ErrorCode::Limit, "the file names more data than a file of its size may")
          .with_rule("crate.too-much");
    }
    left_ -= amount;
    return {};
  }
  /// The same for one thing of so many bytes in memory.
  Result<void> spend_bytes(std::uint64_t size) {
    return spend(1 + size / limits::kCrateBytesPerUnit);
  }

 private:
  std::uint64_t left_;
};

}  // namespace tenon::formats::crate
