// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <mutex>

#include "batch.h"
#include "failure.h"

#include "tenon/math/quaternion.h"
#include "tenon/math/vector.h"

/// How functions on a batch are called from Python, and what they put into arrays.
namespace tenon::python {

/// Calls with the batch to itself; what it returns is of C++.
template <class Call>
auto with(Batch& batch, const Call& call) {
  return unlocked([&] {
    const std::lock_guard held(batch.mutex);
    return call();
  });
}

inline void check_environment(const Batch& batch, std::size_t i) {
  if (i >= batch.size()) {
    throw nb::index_error("there is no such environment");
  }
}

inline void put(const Vec3d& vector, double*& to) {
  to = std::copy(vector.v.begin(), vector.v.end(), to);
}
inline void put(const Quatd& q, double*& to) {
  for (const double part : {q.w, q.x, q.y, q.z}) {
    *to++ = part;
  }
}
}  // namespace tenon::python
