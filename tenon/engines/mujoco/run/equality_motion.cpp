// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// With J the rows of equalities and M the mass matrix, a change x of velocities becomes
// x - M^-1 J^T (J M^-1 J^T)^-1 J x. Instead of inverting the matrix, rows are made orthogonal to
// each other one by one; those that say nothing new, as loops in a plane have them, are skipped. By
// the same rows velocities get the rates J x that MuJoCo refers the equalities to.
#include "tenon/engines/mujoco/run/equality_motion.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "tenon/engines/mujoco/mujoco_library.h"

namespace tenon::engines::mujoco {
namespace {

constexpr double kNothingNew = 1e-9;  // of a row's own product: the rest is rounding

/// Kinematic trees that equalities tie together, by the least of their numbers; -1 without any.
class TiedTrees {
 public:
  explicit TiedTrees(const mjModel& m) : leader_(static_cast<std::size_t>(m.ntree)) {
    std::iota(leader_.begin(), leader_.end(), 0);
    is_tied_.assign(leader_.size(), 0);
    for (int i = 0; i < m.neq; ++i) {
      const int type = m.eq_type[i] == mjEQ_JOINT ? mjOBJ_JOINT : m.eq_objtype[i];
      if (type == mjOBJ_JOINT || type == mjOBJ_BODY || type == mjOBJ_SITE) {
        tie(tree_of(m, type, m.eq_obj1id[i]), tree_of(m, type, m.eq_obj2id[i]));
      } else {  // of tendons, which may run along all
        for (int tree = 0; tree < m.ntree; ++tree) {
          tie(0, tree);
        }
      }
    }
  }

  int of(int tree) { return is_tied_[static_cast<std::size_t>(tree)] != 0 ? find(tree) : -1; }

 private:
  static int tree_of(const mjModel& m, int type, int object) {
    if (object < 0) {
      return -1;
    }
    return m.body_treeid[type == mjOBJ_JOINT  ? m.jnt_bodyid[object]
                         : type == mjOBJ_SITE ? m.site_bodyid[object]
                                              : object];
  }

  int find(int tree) {
    while (leader_[static_cast<std::size_t>(tree)] != tree) {
      tree = leader_[static_cast<std::size_t>(tree)];
    }
    return tree;
  }

  void tie(int a, int b) {
    for (const int tree : {a, b}) {
      if (tree >= 0) {
        is_tied_[static_cast<std::size_t>(tree)] = 1;
      }
    }
    if (a >= 0 && b >= 0) {
      const int first = std::min(find(a), find(b));
      const int second = std::max(find(a), find(b));
      leader_[static_cast<std::size_t>(second)] = first;
    }
  }

  std::vector<int> leader_;
  std::vector<char> is_tied_;
};

/// A row of the Jacobian of constraints (dof_count); which group it acts on, -1: none.
int read_row(const mjModel& m, const mjData& d, int row, const std::vector<int>& group_of,
             std::vector<double>& jacobian) {
  std::fill(jacobian.begin(), jacobian.end(), 0.0);
  int found = -1;
  const bool sparse = mj_isSparse(&m) != 0;
  const auto count = static_cast<int>(sparse ? d.efc_J_rownnz[row] : m.nv);
  const std::ptrdiff_t first = sparse ? d.efc_J_rowadr[row] : std::ptrdiff_t{row} * m.nv;
  for (int k = 0; k < count; ++k) {
    const double value = d.efc_J[first + k];
    if (value != 0) {
      const auto dof = static_cast<std::size_t>(sparse ? d.efc_J_colind[first + k] : k);
      jacobian[dof] = value;
      found = group_of[dof];
    }
  }
  return found;
}

double along(const std::vector<int>& dofs, const std::vector<double>& row, const double* velocity) {
  double sum = 0;
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    sum += row[i] * velocity[dofs[i]];
  }
  return sum;
}

void push(const std::vector<int>& dofs, const std::vector<double>& response, double impulse,
          double* velocity) {
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    velocity[dofs[i]] += impulse * response[i];
  }
}

}  // namespace

EqualityMotion::EqualityMotion(const mjModel& m) {
  group_of_.assign(static_cast<std::size_t>(m.nv), -1);
  jacobian_.assign(group_of_.size(), 0);
  response_.assign(group_of_.size(), 0);
  TiedTrees trees(m);
  std::vector<int> number(static_cast<std::size_t>(m.ntree), -1);
  for (int dof = 0; dof < m.nv; ++dof) {
    const int tree = trees.of(m.dof_treeid[dof]);
    if (tree < 0) {
      continue;
    }
    int& group = number[static_cast<std::size_t>(tree)];
    if (group < 0) {
      group = static_cast<int>(groups_.size());
      groups_.emplace_back();
    }
    group_of_[static_cast<std::size_t>(dof)] = group;
    groups_[static_cast<std::size_t>(group)].dofs.push_back(dof);
  }
}

void EqualityMotion::begin(const mjData& d) {
  if (!groups_.empty()) {
    start_.assign(d.qvel, d.qvel + group_of_.size());
  }
}

void EqualityMotion::end_step() {
  for (Group& group : groups_) {
    group.made = false;
    group.restored = false;
  }
}

void EqualityMotion::restart() {
  for (Group& group : groups_) {
    group.restored = false;
  }
}

void EqualityMotion::add_row(Group& group, int number, const mjModel& m, mjData& d) {
  mj_solveM(&m, &d, response_.data(), jacobian_.data(), 1);
  if (group.count == group.rows.size()) {
    group.rows.emplace_back();
  }
  Row& row = group.rows[group.count];
  row.along.clear();
  row.response.clear();
  double rate = 0;
  for (const int dof : group.dofs) {
    const auto at = static_cast<std::size_t>(dof);
    row.along.push_back(jacobian_[at]);
    row.response.push_back(response_[at]);
    rate += jacobian_[at] * start_[at];
  }
  // The acceleration that MuJoCo refers it to, over the step.
  const double* const reference = d.efc_KBIP + std::ptrdiff_t{4} * number;
  const double apart = d.efc_pos[number] - d.efc_margin[number];
  row.rate = rate - m.opt.timestep * (reference[1] * rate + reference[0] * reference[2] * apart);
  const auto product = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  };
  const double whole = product(row.along, row.response);
  for (std::size_t k = 0; k < group.count; ++k) {
    const Row& before = group.rows[k];
    const double part = product(before.along, row.response) / before.product;
    for (std::size_t i = 0; i < row.along.size(); ++i) {
      row.along[i] -= part * before.along[i];
      row.response[i] -= part * before.response[i];
    }
    row.rate -= part * before.rate;
  }
  row.product = product(row.along, row.response);
  if (row.product > kNothingNew * whole) {
    ++group.count;
  }
}

EqualityMotion::Group* EqualityMotion::made_group(int dof, const mjModel& m, mjData& d) {
  const int number = dof < 0 ? -1 : group_of_[static_cast<std::size_t>(dof)];
  if (number < 0) {
    return nullptr;
  }
  Group& group = groups_[static_cast<std::size_t>(number)];
  if (!group.made) {
    group.made = true;
    group.count = 0;
    for (int row = 0; row < d.ne; ++row) {
      if (read_row(m, d, row, group_of_, jacobian_) == number) {
        add_row(group, row, m, d);
      }
    }
  }
  return &group;
}

bool EqualityMotion::restore(int dof, const mjModel& m, mjData& d) {
  Group* const group = made_group(dof, m, d);
  if (group == nullptr || group->restored) {
    return false;
  }
  group->restored = true;
  for (std::size_t k = 0; k < group->count; ++k) {
    const Row& row = group->rows[k];
    const double wanted = row.rate - along(group->dofs, row.along, d.qvel);
    push(group->dofs, row.response, wanted / row.product, d.qvel);
  }
  return true;
}

void EqualityMotion::answer(int dof, const mjModel& m, mjData& d, double* change) {
  const Group* const group = made_group(dof, m, d);
  for (std::size_t k = 0; group != nullptr && k < group->count; ++k) {
    const Row& row = group->rows[k];
    push(group->dofs, row.response, -along(group->dofs, row.along, change) / row.product, change);
  }
}

}  // namespace tenon::engines::mujoco
