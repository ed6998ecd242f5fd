// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// With A the rows, J the columns of the tree and M_q their inertia, the least impulses with
// A (base + J q) = 0 are found by conjugate gradients on the normal equations (CGLS) in the metric
// of M_q: each round goes along the gradient J^T A^T r that M_q turns into speeds, made conjugate
// to the ways before. Where rows repeat or contradict each other it ends at the least squares.
#include "tenon/scene/motion/loop_impulses.h"

#include <algorithm>
#include <utility>

namespace tenon::scene {
namespace {

constexpr std::size_t kMostRounds = 2000;
constexpr double kExact = 1e-14;  // of the violation that is left, to the one at first

/// What is solved: A (base + J speeds) = 0.
struct LoopProblem {
  const MotionTree& tree;
  const LoopRows& loops;
  const std::vector<Screw>& base;
  const std::vector<double>& given_speeds;
};

std::vector<double> violations(const LoopRows& loops, const std::vector<Screw>& motions,
                               const std::vector<double>& speeds) {
  std::vector<double> result;
  for (const LoopRow& row : loops.rows) {
    result.push_back(speed_along(row, motions));
  }
  for (const SpeedRow& row : loops.speed_rows) {
    result.push_back((speeds[row.follower] - row.ratio * speeds[row.leader]) * row.size);
  }
  return result;
}

std::vector<double> along_columns(const MotionTree& tree, const LoopRows& loops,
                                  const std::vector<double>& impulses) {
  std::vector<Screw> forces(tree.inertias.size());
  for (std::size_t r = 0; r < loops.rows.size(); ++r) {
    const Screw impulse = loops.rows[r].impulse * (loops.rows[r].size * impulses[r]);
    if (loops.rows[r].member0) {
      forces[*loops.rows[r].member0] = forces[*loops.rows[r].member0] - impulse;
    }
    if (loops.rows[r].member1) {
      forces[*loops.rows[r].member1] = forces[*loops.rows[r].member1] + impulse;
    }
  }
  std::vector<double> result = tree.along_columns(std::move(forces));
  for (std::size_t r = 0; r < loops.speed_rows.size(); ++r) {
    const double impulse = impulses[loops.rows.size() + r] * loops.speed_rows[r].size;
    result[loops.speed_rows[r].follower] += impulse;
    result[loops.speed_rows[r].leader] -= impulse * loops.speed_rows[r].ratio;
  }
  for (std::size_t c = 0; c < result.size(); ++c) {
    result[c] = tree.given[c] != 0 ? 0 : result[c];
  }
  return result;
}

double product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += a[i] * b[i];
  }
  return sum;
}

void add(std::vector<double>& to, const std::vector<double>& what, double factor) {
  for (std::size_t i = 0; i < to.size(); ++i) {
    to[i] += what[i] * factor;
  }
}

// The speeds with those that are prescribed, and the motions that they and the base make.
std::vector<double> rest_of(const LoopProblem& problem, const std::vector<double>& speeds) {
  std::vector<Screw> motions = problem.tree.motions(speeds);
  for (std::size_t m = 0; m < motions.size(); ++m) {
    motions[m] = motions[m] + problem.base[m];
  }
  std::vector<double> all = speeds;
  add(all, problem.given_speeds, 1);
  std::vector<double> rest = violations(problem.loops, motions, all);
  for (double& value : rest) {
    value = -value;
  }
  return rest;
}

}  // namespace

double speed_along(const LoopRow& row, const std::vector<Screw>& motions) {
  double sum = row.member1 ? dot(row.impulse, motions[*row.member1]) : 0;
  sum -= row.member0 ? dot(row.impulse, motions[*row.member0]) : 0;
  return sum * row.size;
}

void close_loops(const MotionTree& tree, const TreeInertia& inertia, const LoopRows& loops,
                 const std::vector<Screw>& base, const std::vector<double>& given_speeds,
                 std::vector<double>& speeds) {
  std::vector<double> rest = rest_of({tree, loops, base, given_speeds}, speeds);
  const double at_first = product(rest, rest);
  std::vector<double> gradient = along_columns(tree, loops, rest);
  std::vector<double> step = gradient;
  inertia.solve(step);
  double steepness = product(gradient, step);
  std::vector<double> way = step;
  const std::size_t rounds = std::min(kMostRounds, 10 * rest.size() + 50);
  for (std::size_t i = 0; i < rounds && steepness > 0; ++i) {
    if (product(rest, rest) <= kExact * kExact * at_first) {
      break;
    }
    const std::vector<double> change = violations(loops, tree.motions(way), way);
    const double reach = product(change, change);
    if (!(reach > 0)) {
      break;
    }
    add(speeds, way, steepness / reach);
    add(rest, change, -steepness / reach);
    gradient = along_columns(tree, loops, rest);
    step = gradient;
    inertia.solve(step);
    const double next = product(gradient, step);
    for (std::size_t c = 0; c < way.size(); ++c) {
      way[c] = step[c] + way[c] * (next / steepness);
    }
    steepness = next;
  }
}

}  // namespace tenon::scene
