// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/motion/tree_inertia.h"

namespace tenon::scene {
namespace {

constexpr double kNothing = 1e-14;  // the rest of a column's inertia when others carry it all

}  // namespace

void RigidInertia::add(const RigidInertia& other) {
  mass += other.mass;
  moment += other.moment;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      inertia[i][j] += other.inertia[i][j];
    }
  }
}

std::vector<Screw> MotionTree::motions(const std::vector<double>& speeds) const {
  std::vector<Screw> result(parents.size());
  std::size_t column = 0;
  for (std::size_t m = 0; m < parents.size(); ++m) {
    if (parents[m] != kNone) {
      result[m] = result[parents[m]];
    }
    for (; column < members.size() && members[column] == m; ++column) {
      result[m] = result[m] + screws[column] * speeds[column];
    }
  }
  return result;
}

std::vector<double> MotionTree::along_columns(std::vector<Screw> forces) const {
  std::vector<double> result(members.size(), 0.0);
  std::size_t column = members.size();
  for (std::size_t m = parents.size(); m-- > 0;) {
    for (; column > 0 && members[column - 1] == m; --column) {
      result[column - 1] = dot(screws[column - 1], forces[m]);
    }
    if (parents[m] != kNone) {
      forces[parents[m]] = forces[parents[m]] + forces[m];
    }
  }
  return result;
}

TreeInertia::TreeInertia(const MotionTree& tree, const std::vector<double>& armatures) {
  set_up(tree, armatures);
  factor();
}

// The entry of two columns is the momentum that one gives to what it carries, along the other.
void TreeInertia::set_up(const MotionTree& tree, const std::vector<double>& armatures) {
  std::vector<RigidInertia> carried = tree.inertias;
  for (std::size_t m = tree.parents.size(); m-- > 0;) {
    if (tree.parents[m] != MotionTree::kNone) {
      carried[tree.parents[m]].add(carried[m]);
    }
  }
  const std::size_t count = tree.members.size();
  std::vector<std::size_t> last(tree.parents.size(), MotionTree::kNone);
  above_.assign(count, MotionTree::kNone);
  depth_.assign(count, 0);
  rows_.resize(count);
  moves_.assign(count, 0);
  std::size_t column = 0;
  for (std::size_t m = 0; m < tree.parents.size(); ++m) {
    last[m] = tree.parents[m] == MotionTree::kNone ? MotionTree::kNone : last[tree.parents[m]];
    for (; column < count && tree.members[column] == m; ++column) {
      if (tree.given[column] != 0) {
        continue;
      }
      above_[column] = last[m];
      depth_[column] = last[m] == MotionTree::kNone ? 0 : depth_[last[m]] + 1;
      last[m] = column;
      rows_[column].resize(depth_[column] + 1);
      const Screw momentum = carried[m].momentum(tree.screws[column]);
      for (std::size_t k = column; k != MotionTree::kNone; k = above_[k]) {
        rows_[column][depth_[k]] = dot(tree.screws[k], momentum);
      }
      rows_[column].back() += armatures.empty() ? 0 : armatures[column];
    }
  }
}

void TreeInertia::factor() {
  std::vector<double> whole;
  for (const std::vector<double>& row : rows_) {
    whole.push_back(row.empty() ? 0 : row.back());
  }
  for (std::size_t k = rows_.size(); k-- > 0;) {
    std::vector<double>& row = rows_[k];
    if (row.empty() || !(row.back() > kNothing * whole[k])) {
      continue;
    }
    moves_[k] = 1;
    for (std::size_t i = above_[k]; i != MotionTree::kNone; i = above_[i]) {
      const double factor = row[depth_[i]] / row.back();
      for (std::size_t j = 0; j <= depth_[i]; ++j) {
        rows_[i][j] -= factor * row[j];
      }
      row[depth_[i]] = factor;
    }
  }
}

void TreeInertia::solve(std::vector<double>& values) const {
  for (std::size_t k = rows_.size(); k-- > 0;) {
    for (std::size_t i = above_[k]; moves_[k] != 0 && i != MotionTree::kNone; i = above_[i]) {
      values[i] -= rows_[k][depth_[i]] * values[k];
    }
  }
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    values[k] = moves_[k] != 0 ? values[k] / rows_[k].back() : 0;
    for (std::size_t i = above_[k]; moves_[k] != 0 && i != MotionTree::kNone; i = above_[i]) {
      values[k] -= rows_[k][depth_[i]] * values[i];
    }
  }
}

}  // namespace tenon::scene
