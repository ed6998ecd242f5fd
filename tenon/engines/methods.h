// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// How a step is made, in words that engines share. An engine that knows none of a kind, or not the
/// one that is asked for, says so when the simulation is made (Unsupported, rule engine.method).
namespace tenon::engines {

enum class Integrator : std::uint8_t {
  Default,       ///< what the asset asks for, else the engine's
  Euler,         ///< semi-implicit; damping of joints at the end of the step
  ImplicitFast,  ///< velocity-dependent forces at the end of the step, except the gyroscopic ones
  Implicit,      ///< the gyroscopic ones too
  RungeKutta4,   ///< four evaluations a step
};

enum class ConstraintSolver : std::uint8_t {
  Default,
  Newton,
  ConjugateGradient,
  ProjectedGaussSeidel,
};

struct Methods {
  Integrator integrator = Integrator::Default;
  ConstraintSolver solver = ConstraintSolver::Default;
  int iterations = 0;  ///< of the solver, at most; 0: what the asset asks for, else the engine's
  bool operator==(const Methods&) const = default;
};

/// "euler", "implicitfast", "implicit", "rk4"; "" of Default.
std::string_view integrator_name(Integrator integrator);
/// "newton", "cg", "pgs"; "" of Default.
std::string_view solver_name(ConstraintSolver solver);
/// Those that can be asked for.
std::vector<std::string> integrator_names();
std::vector<std::string> solver_names();
/// No value for an unknown name; "" is Default.
std::optional<Integrator> integrator_named(std::string_view name);
std::optional<ConstraintSolver> solver_named(std::string_view name);

}  // namespace tenon::engines
