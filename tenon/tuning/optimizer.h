// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tenon/base/function.h"
#include "tenon/base/result.h"

namespace tenon::tuning {

/// A function of a few variables to be made small within bounds, while every constraint is at most
/// 0. Lists have (variable_count) entries.
struct Problem {
  std::vector<double> start;
  std::vector<double> lower;
  std::vector<double> upper;
  std::vector<double> step;  ///< of the first tries, above 0
  std::size_t constraint_count = 0;
  std::size_t most_tries = 60;
  double tolerance = 1e-3;  ///< of each variable: smaller steps end it
};

struct Tried {
  double value = 0;
  std::vector<double> constraints;  // (constraint_count)
};

/// Tries points by the method of linear approximations (COBYLA, Powell 1994) of the library NLopt,
/// which is opened when it is first needed. `attempt` has to remember what it was asked: the last
/// point is not the best one by necessity. `attempt` sets `stop` to end the search. The same
/// answers give the same points. Errors: Missing (tune.no-nlopt) without the library; Unsupported
/// (tune.search) where it gives up.
Result<void> minimize(const Problem& problem,
                      const Function<Tried(const std::vector<double>& point, bool& stop)>& attempt);

/// "2.7.1"; "" where the library is not there.
std::string optimizer_version();

}  // namespace tenon::tuning
