// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each step solves least squares with damping for the speeds of the columns of the group's tree:
// J x = e, damped by mu times the squared error, with C x = 0 for loops and mimics (constraints.h)
// as equations. A coordinate that the step would carry beyond a bound goes as far as the bound, and
// the rest is solved again with that as a further equation, followers and loops included. A step
// that makes the error smaller is taken and mu shrinks, else mu grows.
#include "tenon/dynamics/reach_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Dense>

#include "tenon/dynamics/constraints.h"
#include "tenon/dynamics/drawn_postures.h"
#include "tenon/dynamics/loop_closure.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::dynamics {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using scene::JointDofs;
using scene::JointTree;
using scene::MotionTree;

constexpr int kReachSteps = 300;
constexpr int kIdleReachSteps = 12;   // without a gain that is worth it
constexpr double kWorthwhile = 1e-4;  // of the error
constexpr double kLongestTurn = 0.7;  // of a step [rad, or m by the length]
constexpr double kReachRank = 1e-9;
constexpr double kBeyond = 1e-7;   // of a bound, as loops and powers of mimics bend [rad or m]
constexpr double kTouches = 1e-6;  // a bound [rad or m]
constexpr double kMostDamping = 1e9;

JointTree tree_at(const Multibody& multibody, const Posture& posture, std::size_t group) {
  return {multibody.scene(), multibody.forest(),        multibody.dofs(),
          posture.bodies,    multibody.groups()[group], {0, 0, scene::TiedMimics::All}};
}

Pose frame_of(const Posture& posture, const ReachTarget& target) {
  return posture.bodies[target.body] * target.frame;
}

Vec3d turn_left(const Posture& posture, const ReachTarget& target) {
  const Quatd now = frame_of(posture, target).orientation;
  return target.orientation ? rotation_vector(normalized(*target.orientation * conjugate(now)))
                            : Vec3d{};
}

std::size_t row_count(const ReachTask& task) {
  std::size_t rows = 0;
  for (const ReachTarget& target : task.targets) {
    rows += target.orientation ? 6 : 3;
  }
  return rows;
}

Eigen::Index to_index(std::size_t i) { return static_cast<Eigen::Index>(i); }

VectorXd errors_of(const ReachTask& task, const Posture& posture) {
  VectorXd errors(to_index(row_count(task)));
  Eigen::Index row = 0;
  for (const ReachTarget& target : task.targets) {
    const Vec3d way = target.position - frame_of(posture, target).position;
    const Vec3d turn = turn_left(posture, target);
    for (std::size_t i = 0; i < 3; ++i) {
      errors[row++] = way[i] / task.length;
    }
    for (std::size_t i = 0; target.orientation && i < 3; ++i) {
      errors[row++] = turn[i];
    }
  }
  return errors;
}

/// The rows of errors_of by the columns of the tree.
MatrixXd jacobian_of(const ReachTask& task, const Posture& posture, const JointTree& tree) {
  const MotionTree& motions = tree.tree();
  MatrixXd matrix = MatrixXd::Zero(to_index(row_count(task)), to_index(motions.members.size()));
  Eigen::Index row = 0;
  for (const ReachTarget& target : task.targets) {
    const Vec3d place = frame_of(posture, target).position - tree.origin();
    for (std::size_t m = tree.member_of(target.body); m != MotionTree::kNone;
         m = motions.parents[m]) {
      const auto begin = std::lower_bound(motions.members.begin(), motions.members.end(), m);
      for (auto c = begin; c != motions.members.end() && *c == m; ++c) {
        const auto column = static_cast<std::size_t>(c - motions.members.begin());
        const Vec3d velocity = velocity_at(motions.screws[column], place);
        for (std::size_t i = 0; i < 3; ++i) {
          matrix(row + to_index(i), to_index(column)) = velocity[i] / task.length;
          if (target.orientation) {
            matrix(row + 3 + to_index(i), to_index(column)) = motions.screws[column].turn[i];
          }
        }
      }
    }
    row += target.orientation ? 6 : 3;
  }
  return matrix;
}

/// A column that may move, and how far it may [m or rad].
struct FreeColumn {
  std::size_t column = 0;
  double down = -scene::kUnlimited;
  double up = scene::kUnlimited;
  double unit = 1;  // a step by this much is a long one
};

std::vector<FreeColumn> free_columns(const ReachTask& task, const Posture& posture,
                                     const JointTree& tree) {
  std::vector<FreeColumn> columns;
  for (const auto& [joint, first] : tree.first_columns()) {
    if (!task.moves[joint]) {
      continue;
    }
    const JointDofs& dofs = task.multibody->dofs()[joint];
    for (std::size_t i = 0; i < dofs.count(); ++i) {
      FreeColumn column{first + i};
      if (i < dofs.free.size()) {
        const double at = posture.joints[joint][i];
        column.unit = is_angular(dofs.free[i].dof) ? 1 : task.length;
        if (task.limits == KeepLimits::Yes) {
          column.down = dofs.free[i].lower - at;
          column.up = dofs.free[i].upper - at;
        }
      }
      columns.push_back(column);
    }
  }
  std::sort(columns.begin(), columns.end(),
            [](const FreeColumn& a, const FreeColumn& b) { return a.column < b.column; });
  return columns;
}

MatrixXd columns_of(const MatrixXd& matrix, const std::vector<FreeColumn>& columns) {
  MatrixXd chosen(matrix.rows(), to_index(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    chosen.col(to_index(i)) = matrix.col(to_index(columns[i].column));
  }
  return chosen;
}

/// Least squares with damping under equations.
struct StepProblem {
  MatrixXd jacobian;  // (error_count x free_count)
  VectorXd errors;
  MatrixXd equations;  // (row_count x free_count), = 0
  double damping = 0;  // of squared speeds
};

/// Some columns go a given way: index of a free column, and the way.
using Fixed = std::vector<std::pair<std::size_t, double>>;

VectorXd solve_step(const StepProblem& problem, const Fixed& fixed) {
  const Eigen::Index n = problem.jacobian.cols();
  const Eigen::Index held = problem.equations.rows();
  MatrixXd equations = MatrixXd::Zero(held + to_index(fixed.size()), n);
  VectorXd values = VectorXd::Zero(equations.rows());
  equations.topRows(held) = problem.equations;
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    equations(held + to_index(i), to_index(fixed[i].first)) = 1;
    values[held + to_index(i)] = fixed[i].second;
  }
  VectorXd given = VectorXd::Zero(n);
  MatrixXd basis = MatrixXd::Identity(n, n);
  if (equations.rows() > 0) {
    Eigen::ColPivHouseholderQR<MatrixXd> factors(equations.rows() > 0 ? n : 0, equations.rows());
    factors.setThreshold(kReachRank);
    factors.compute(equations.transpose());
    const MatrixXd all = factors.householderQ() * MatrixXd::Identity(n, n);
    basis = all.rightCols(n - factors.rank());
    Eigen::CompleteOrthogonalDecomposition<MatrixXd> least;
    least.setThreshold(kReachRank);
    least.compute(equations);
    given = least.solve(values);
  }
  const MatrixXd reduced = problem.jacobian * basis;
  MatrixXd normal = reduced.transpose() * reduced;
  normal.diagonal().array() += problem.damping;
  const VectorXd wanted = reduced.transpose() * (problem.errors - problem.jacobian * given);
  return basis.cols() == 0 ? given : VectorXd(given + basis * normal.ldlt().solve(wanted));
}

/// The step within bounds, as far as equations let it.
VectorXd bounded_step(const StepProblem& problem, const std::vector<FreeColumn>& columns) {
  Fixed fixed;
  VectorXd step = solve_step(problem, fixed);
  for (std::size_t round = 0; round < columns.size(); ++round) {
    const std::size_t before = fixed.size();
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const double way = step[to_index(i)];
      const bool is_fixed =
          std::any_of(fixed.begin(), fixed.end(), [i](const auto& one) { return one.first == i; });
      if (!is_fixed && (way > columns[i].up + 1e-12 || way < columns[i].down - 1e-12)) {
        fixed.emplace_back(i, std::clamp(way, columns[i].down, columns[i].up));
      }
    }
    if (fixed.size() == before) {
      break;
    }
    step = solve_step(problem, fixed);
  }
  double longest = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    longest = std::max(longest, std::abs(step[to_index(i)]) / columns[i].unit);
  }
  return longest > kLongestTurn ? VectorXd(step * (kLongestTurn / longest)) : step;
}

/// By how much a coordinate that may move is beyond a bound, at most [m or rad].
double beyond_limits(const ReachTask& task, const Posture& posture) {
  double worst = 0;
  for (Index j = 0; task.limits == KeepLimits::Yes && j < posture.joints.size(); ++j) {
    const JointDofs& dofs = task.multibody->dofs()[j];
    const bool counts =
        task.moves[j] && task.multibody->forest().joints[j] == scene::ForestRole::Tree;
    for (std::size_t i = 0; counts && i < dofs.free.size(); ++i) {
      const double at = posture.joints[j][i];
      worst = std::max({worst, dofs.free[i].lower - at, at - dofs.free[i].upper});
    }
  }
  return worst;
}

/// The posture after a step.
Posture stepped(const ReachTask& task, const Posture& from, const JointTree& tree,
                const std::vector<FreeColumn>& columns, const VectorXd& step) {
  VectorXd all = VectorXd::Zero(to_index(tree.tree().members.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    all[to_index(columns[i].column)] = step[to_index(i)];
  }
  std::vector<std::vector<double>> joints = from.joints;
  for (const auto& [joint, first] : tree.first_columns()) {
    if (task.moves[joint]) {
      move_joint(task.multibody->dofs()[joint], all, first, joints[joint]);
      if (task.limits == KeepLimits::Yes) {
        keep_in_cone(task.multibody->scene().joints[joint], task.multibody->dofs()[joint],
                     joints[joint]);
      }
    }
  }
  return task.multibody->moved(from, std::move(joints));
}

/// The search from one posture on.
class Search {
 public:
  Search(const ReachTask& task, Posture from)
      : task_(task),
        posture_(std::move(from)),
        group_(task.multibody->group_of()[task.targets.front().body]),
        error_(errors_of(task, posture_).squaredNorm()),
        beyond_(beyond_limits(task, posture_)) {}

  ReachRun run() {
    for (int i = 0; i < kReachSteps && idle_ < kIdleReachSteps && damping_ < kMostDamping; ++i) {
      if (error_ < 1e-24 && beyond_ <= kBeyond) {
        break;
      }
      step();
    }
    ReachRun result{posture_, gaps_of(posture_, task_.targets), error_, false};
    result.reached = std::all_of(result.gaps.begin(), result.gaps.end(), [&](const ReachGap& gap) {
      return gap.distance <= task_.distance && gap.angle <= task_.angle;
    });
    const bool is_possible =
        beyond_ <= kTouches && task_.multibody->loop_gap(posture_) <= task_.distance;
    result.reached = result.reached && is_possible;
    result.error = is_possible ? error_ : scene::kUnlimited;
    return result;
  }

 private:
  void step() {
    const JointTree tree = tree_at(*task_.multibody, posture_, group_);
    const std::vector<FreeColumn> columns = free_columns(task_, posture_, tree);
    StepProblem problem;
    problem.jacobian = columns_of(jacobian_of(task_, posture_, tree), columns);
    problem.errors = errors_of(task_, posture_);
    problem.equations = columns_of(constraint_matrix(tree), columns);
    while (damping_ < kMostDamping) {
      problem.damping = damping_ * error_ + 1e-13;
      Posture next = stepped(task_, posture_, tree, columns, bounded_step(problem, columns));
      const double error = errors_of(task_, next).squaredNorm();
      const double beyond = beyond_limits(task_, next);
      // First back within limits, whatever that does to the error.
      const bool is_better =
          beyond_ > kBeyond ? beyond < beyond_ / 2 : error < error_ && beyond <= kBeyond;
      if (is_better) {
        idle_ = error > error_ * (1 - kWorthwhile) ? idle_ + 1 : 0;
        posture_ = std::move(next);
        error_ = error;
        beyond_ = beyond;
        damping_ = std::max(damping_ / 8, 1e-4);
        return;
      }
      damping_ = std::max(damping_, 0.01) * 6;
    }
  }

  const ReachTask& task_;
  Posture posture_;
  std::size_t group_;
  double error_;
  double beyond_;
  double damping_ = 0.5;
  int idle_ = 0;
};

/// Columns that an equation ties to a chosen one are chosen, too; until there are no more.
void add_tied(const MatrixXd& equations, std::vector<bool>& chosen) {
  constexpr double kTied = 1e-12;
  bool more = true;
  while (more) {
    more = false;
    for (Eigen::Index r = 0; r < equations.rows(); ++r) {
      bool any = false;
      bool all = true;
      for (Eigen::Index c = 0; c < equations.cols(); ++c) {
        if (std::abs(equations(r, c)) > kTied) {
          any = any || chosen[static_cast<std::size_t>(c)];
          all = all && chosen[static_cast<std::size_t>(c)];
        }
      }
      for (Eigen::Index c = 0; any && !all && c < equations.cols(); ++c) {
        if (std::abs(equations(r, c)) > kTied) {
          chosen[static_cast<std::size_t>(c)] = true;
          more = true;
        }
      }
    }
  }
}

}  // namespace

std::vector<bool> joints_of_frames(const Multibody& multibody, const Posture& posture,
                                   const std::vector<ReachTarget>& targets) {
  const std::size_t group = multibody.group_of()[targets.front().body];
  const JointTree tree = tree_at(multibody, posture, group);
  const MotionTree& motions = tree.tree();
  std::vector<bool> chosen(motions.members.size(), false);
  for (const ReachTarget& target : targets) {
    for (std::size_t m = tree.member_of(target.body); m != MotionTree::kNone;
         m = motions.parents[m]) {
      for (std::size_t c = 0; c < motions.members.size(); ++c) {
        chosen[c] = chosen[c] || motions.members[c] == m;
      }
    }
  }
  add_tied(constraint_matrix(tree), chosen);
  std::vector<bool> joints(multibody.scene().joints.size(), false);
  for (const auto& [joint, first] : tree.first_columns()) {
    for (std::size_t i = 0; i < multibody.dofs()[joint].count(); ++i) {
      joints[joint] = joints[joint] || chosen[first + i];
    }
  }
  return joints;
}

std::vector<ReachGap> gaps_of(const Posture& posture, const std::vector<ReachTarget>& targets) {
  std::vector<ReachGap> gaps;
  for (const ReachTarget& target : targets) {
    gaps.push_back({length(target.position - frame_of(posture, target).position),
                    length(turn_left(posture, target))});
  }
  return gaps;
}

std::vector<AtLimit> at_limits(const Multibody& multibody, const Posture& posture,
                               const std::vector<bool>& joints) {
  std::vector<AtLimit> found;
  for (Index j = 0; j < joints.size(); ++j) {
    const std::vector<scene::FreeDof>& free = multibody.dofs()[j].free;
    for (std::size_t i = 0; joints[j] && i < free.size(); ++i) {
      for (const double bound : {free[i].lower, free[i].upper}) {
        if (std::abs(posture.joints[j][i] - bound) <= kTouches) {
          found.push_back({j, free[i].dof, bound});
          break;
        }
      }
    }
  }
  return found;
}

ReachRun reach_from(const ReachTask& task, const Posture& from) {
  const bool keeps = task.limits == KeepLimits::Yes;
  return Search(task, keeps ? inside_limits(*task.multibody, from, task.moves) : from).run();
}

}  // namespace tenon::dynamics
