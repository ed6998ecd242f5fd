// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "tenon/base/result.h"
#include "tenon/stage/stage.h"

namespace tenon::stage {

/// The work of several compositions of one asset, under its variants or after each of its edits.
/// Each is bounded by itself; together they may take twice limits::kComposeWork, and what the
/// sizes of their layers allow.
class WorkAccount {
 public:
  /// `max_work` as in compose::ComposeOptions; 0: the limit.
  explicit WorkAccount(std::size_t max_work = 0);

  /// Adds what `stage` took. ErrorCode::Limit, rule "compose.work-exceeded", when it was not
  /// composed to its end, so that what is made of it would be a part, or when all is too much.
  Result<void> spend(const Stage& stage);

 private:
  std::size_t most_;
  std::size_t spent_ = 0;
  std::size_t allowed_ = 0;
};

}  // namespace tenon::stage
