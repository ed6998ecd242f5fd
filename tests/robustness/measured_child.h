// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace tenon::robustness {

/// What an input of so many bytes may cost to read: 1 s of processor time for each megabyte begun,
/// 64 MB and 40 times its size of memory.
struct Allowance {
  double seconds = 0;
  std::size_t bytes = 0;
};
Allowance allowance_of(std::size_t input_size);

struct Cost {
  double seconds = 0;       ///< processor time
  std::size_t bytes = 0;    ///< most memory in use beyond what there was at the start
  std::uint64_t taken = 0;  ///< bytes taken from the heap, all together: a count of work that is
                            ///< the same on every machine; 0 under sanitizers
  std::string failure;      ///< "": ended well; else how it died, "crash", "time" or "memory"
  int outcome = 0;          ///< what `work` returned

  /// "": within the allowance; else what was too much. Time: what `work` itself took, for a
  /// measurement; Hang: only that it had to be ended, for a test.
  enum class Judge : unsigned char { Time, Hang };
  std::string excess(const Allowance& allowance, Judge judge) const;
};

/// Runs `work` in a child process and measures it. The child is ended when it takes ten times the
/// allowance. Time is tenfold under sanitizers and without
/// optimisation; memory does not count under sanitizers, which have their own.
Cost measure(const std::function<int()>& work, const Allowance& allowance);

}  // namespace tenon::robustness
