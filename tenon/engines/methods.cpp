// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/methods.h"

#include <algorithm>
#include <iterator>

namespace tenon::engines {
namespace {

constexpr std::string_view kIntegratorNames[] = {"", "euler", "implicitfast", "implicit", "rk4"};
constexpr std::string_view kSolverNames[] = {"", "newton", "cg", "pgs"};
static_assert(std::size(kIntegratorNames) == std::size_t(Integrator::RungeKutta4) + 1);
static_assert(std::size(kSolverNames) == std::size_t(ConstraintSolver::ProjectedGaussSeidel) + 1);

template <std::size_t count>
std::vector<std::string> but_the_first(const std::string_view (&names)[count]) {
  return {std::begin(names) + 1, std::end(names)};
}

template <class Kind, std::size_t count>
std::optional<Kind> named(const std::string_view (&names)[count], std::string_view name) {
  const auto* found = std::find(std::begin(names), std::end(names), name);
  return found == std::end(names) ? std::nullopt
                                  : std::optional(static_cast<Kind>(found - std::begin(names)));
}

}  // namespace

std::string_view integrator_name(Integrator integrator) {
  return kIntegratorNames[std::size_t(integrator)];
}
std::string_view solver_name(ConstraintSolver solver) { return kSolverNames[std::size_t(solver)]; }

std::vector<std::string> integrator_names() { return but_the_first(kIntegratorNames); }
std::vector<std::string> solver_names() { return but_the_first(kSolverNames); }

std::optional<Integrator> integrator_named(std::string_view name) {
  return named<Integrator>(kIntegratorNames, name);
}
std::optional<ConstraintSolver> solver_named(std::string_view name) {
  return named<ConstraintSolver>(kSolverNames, name);
}

}  // namespace tenon::engines
