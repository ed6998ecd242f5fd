// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/error.h"

namespace tenon::cli {

/// Exit codes that scripts rely on.
enum ExitCode : int {
  kOk = 0,
  kNo = 1,        ///< the answer is "no": findings, a difference, over tolerance
  kFailed = 2,    ///< usage, I/O or parse error
  kUnstable = 3,  ///< a simulation became unstable
  kMissing = 4,   ///< an engine or optional part is not installed
  kInterrupted = 130,
};

inline int exit_code_of(const Error& error) {
  if (error.code() == ErrorCode::Unstable) {
    return kUnstable;
  }
  return error.code() == ErrorCode::Missing ? kMissing : kFailed;
}

}  // namespace tenon::cli
