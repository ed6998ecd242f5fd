// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The C interface of NLopt, as it has been since 2.0: opened at run time, so that a program that
// never searches needs neither the library nor its header. The algorithm is asked for by its name,
// because numbers of algorithms differ between releases. It asks for objective and constraints one
// after the other at the same point, which is tried once.
#include "tenon/tuning/optimizer.h"

#include <array>
#include <utility>

#include "tenon/base/shared_library.h"

namespace tenon::tuning {
namespace {

constexpr const char* kLibrary = "libnlopt.so.0";
constexpr const char* kNewerLibrary = "libnlopt.so.1";
constexpr const char* kAlgorithm = "LN_COBYLA";
constexpr int kForcedStop = -5;
constexpr int kRoundoffLimited = -4;

struct Opaque;
using Objective = double(unsigned, const double*, double*, void*);
using Constraints = void(unsigned, double*, unsigned, const double*, double*, void*);
using Numbers = int(Opaque*, const double*);

struct Nlopt {
  int (*algorithm)(const char*) = nullptr;
  Opaque* (*create)(int, unsigned) = nullptr;
  void (*destroy)(Opaque*) = nullptr;
  int (*optimize)(Opaque*, double*, double*) = nullptr;
  int (*set_objective)(Opaque*, Objective*, void*) = nullptr;
  int (*add_constraints)(Opaque*, unsigned, Constraints*, void*, const double*) = nullptr;
  Numbers* set_lower = nullptr;
  Numbers* set_upper = nullptr;
  Numbers* set_step = nullptr;
  int (*set_tolerance)(Opaque*, double) = nullptr;
  int (*set_most_tries)(Opaque*, int) = nullptr;
  int (*stop)(Opaque*) = nullptr;
  void (*version)(int*, int*, int*) = nullptr;
  bool complete = false;
};

Nlopt load_nlopt() {
  Nlopt n;
  const SharedLibrary library =
      SharedLibrary::open({own_library(kLibrary), kLibrary, kNewerLibrary});
  n.complete = library && library.find("nlopt_algorithm_from_string", n.algorithm) &&
               library.find("nlopt_create", n.create) && library.find("nlopt_destroy", n.destroy) &&
               library.find("nlopt_optimize", n.optimize) &&
               library.find("nlopt_set_min_objective", n.set_objective) &&
               library.find("nlopt_add_inequality_mconstraint", n.add_constraints) &&
               library.find("nlopt_set_lower_bounds", n.set_lower) &&
               library.find("nlopt_set_upper_bounds", n.set_upper) &&
               library.find("nlopt_set_initial_step", n.set_step) &&
               library.find("nlopt_set_xtol_abs1", n.set_tolerance) &&
               library.find("nlopt_set_maxeval", n.set_most_tries) &&
               library.find("nlopt_force_stop", n.stop) && library.find("nlopt_version", n.version);
  return n;
}

const Nlopt& nlopt() {
  static const Nlopt loaded = load_nlopt();
  return loaded;
}

/// What the callbacks of one search share.
struct Search {
  const Function<Tried(const std::vector<double>& point, bool& stop)>& attempt;
  Opaque* optimizer = nullptr;
  std::vector<double> point;
  Tried tried;

  const Tried& at(unsigned count, const double* x) {
    std::vector<double> asked(x, x + count);
    if (asked != point) {
      bool stop = false;
      point = std::move(asked);
      tried = attempt(point, stop);
      if (stop) {
        nlopt().stop(optimizer);
      }
    }
    return tried;
  }
};

double objective_at(unsigned count, const double* x, double* /*gradient*/, void* data) {
  return static_cast<Search*>(data)->at(count, x).value;
}

void constraints_at(unsigned constraint_count, double* result, unsigned count, const double* x,
                    double* /*gradient*/, void* data) {
  const Tried& tried = static_cast<Search*>(data)->at(count, x);
  for (unsigned i = 0; i < constraint_count; ++i) {
    result[i] = i < tried.constraints.size() ? tried.constraints[i] : 0;
  }
}

class Optimizer {
 public:
  Optimizer(int algorithm, std::size_t variables)
      : handle_(nlopt().create(algorithm, static_cast<unsigned>(variables))) {}
  Optimizer(const Optimizer&) = delete;
  Optimizer& operator=(const Optimizer&) = delete;
  ~Optimizer() {
    if (handle_ != nullptr) {
      nlopt().destroy(handle_);
    }
  }

  bool set_up(const Problem& problem, Search& search) {
    const Nlopt& n = nlopt();
    search.optimizer = handle_;
    const std::vector<double> exact(problem.constraint_count, 0);
    return handle_ != nullptr && n.set_objective(handle_, objective_at, &search) > 0 &&
           n.set_lower(handle_, problem.lower.data()) > 0 &&
           n.set_upper(handle_, problem.upper.data()) > 0 &&
           n.set_step(handle_, problem.step.data()) > 0 &&
           n.set_tolerance(handle_, problem.tolerance) > 0 &&
           n.set_most_tries(handle_, static_cast<int>(problem.most_tries)) > 0 &&
           (exact.empty() || n.add_constraints(handle_, static_cast<unsigned>(exact.size()),
                                               constraints_at, &search, exact.data()) > 0);
  }

  int run(std::vector<double> point) const {
    double value = 0;
    return nlopt().optimize(handle_, point.data(), &value);
  }

 private:
  Opaque* handle_;
};

}  // namespace

Result<void> minimize(
    const Problem& problem,
    const Function<Tried(const std::vector<double>& point, bool& stop)>& attempt) {
  if (!nlopt().complete) {
    return Error(ErrorCode::Missing, "the library NLopt is not there, which searches gains")
        .with_rule("tune.no-nlopt")
        .with_fix("install libnlopt0");
  }
  Search search{attempt, nullptr, {}, {}};
  Optimizer optimizer(nlopt().algorithm(kAlgorithm), problem.start.size());
  if (!optimizer.set_up(problem, search)) {
    return Error(ErrorCode::Unsupported, "NLopt refuses the search").with_rule("tune.search");
  }
  const int ended = optimizer.run(problem.start);
  if (ended < 0 && ended != kForcedStop && ended != kRoundoffLimited) {
    return Error(ErrorCode::Unsupported, "NLopt gave the search up (" + std::to_string(ended) + ")")
        .with_rule("tune.search");
  }
  return {};
}

std::string optimizer_version() {
  if (!nlopt().complete) {
    return "";
  }
  std::array<int, 3> parts{};
  nlopt().version(&parts[0], &parts[1], &parts[2]);
  return std::to_string(parts[0]) + "." + std::to_string(parts[1]) + "." + std::to_string(parts[2]);
}

}  // namespace tenon::tuning
