// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>
#include <type_traits>
#include <utility>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"

/// What the examples share: an error ends them, findings are told.

template <class T>
T or_exit(tenon::Result<T> result) {
  if (!result) {
    std::fprintf(stderr, "%s\n", result.error().to_string().c_str());
    std::exit(2);
  }
  if constexpr (!std::is_void_v<T>) {
    return *std::move(result);
  }
}

inline void tell(const tenon::Diagnostics& diagnostics) {
  for (const tenon::Diagnostic& finding : diagnostics) {
    std::fprintf(stderr, "%s\n", finding.to_string().c_str());
  }
}
