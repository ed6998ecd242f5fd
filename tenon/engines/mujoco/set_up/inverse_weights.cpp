// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The weight of a body is the mean of the diagonal of J M^-1 J^T at its centre of mass: how it
// answers to forces on it. MuJoCo solves with M for each body. Along a tree the same follows from
// two passes (Kreutz-Delgado, Jain and Rodriguez, Recursive Formulation of Operational Space
// Control, 1992):
//
// Upwards, each degree of freedom with axis S takes itself out of the inertia of what it carries:
//   U = I S, D = S^T U + armature, I' = I - U U^T / D.
// Downwards, the answer W of a body to forces on it (its inverse inertia, all that hangs on it and
// all that it hangs on counted) follows from that of what carries it:
//   W' = L^T W L + S S^T / D with L = 1 - U S^T / D,
// and the entry of M^-1 on the diagonal is 1 / D + U^T W U / D^2.
//
// Everything is about the centre of mass of the body at hand, in world axes, so that no digits are
// lost where a scene is far from the origin.
#include "tenon/engines/mujoco/set_up/inverse_weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "tenon/engines/mujoco/model.h"

namespace tenon::engines::mujoco {
namespace {

using Vec6 = std::array<double, 6>;  // turn, then move
using Mat6 = std::array<Vec6, 6>;

std::size_t place(mjtSize index) { return static_cast<std::size_t>(index); }

Vec6 times(const Mat6& m, const Vec6& v) {
  Vec6 result{};
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t k = 0; k < 6; ++k) {
      result[i] += m[i][k] * v[k];
    }
  }
  return result;
}

double dot6(const Vec6& a, const Vec6& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    sum += a[i] * b[i];
  }
  return sum;
}

/// m + factor a b^T
void add_outer(Mat6& m, const Vec6& a, const Vec6& b, double factor) {
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t k = 0; k < 6; ++k) {
      m[i][k] += factor * a[i] * b[k];
    }
  }
}

void add(Mat6& m, const Mat6& other) {
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t k = 0; k < 6; ++k) {
      m[i][k] += other[i][k];
    }
  }
}

Vec6 of(const Vec3d& turn, const Vec3d& move) {
  return {turn[0], turn[1], turn[2], move[0], move[1], move[2]};
}

Vec3d turn_of(const Vec6& v) { return {{v[0], v[1], v[2]}}; }
Vec3d move_of(const Vec6& v) { return {{v[3], v[4], v[5]}}; }

/// A motion as a point that is `way` farther sees it.
Vec6 moved(const Vec6& v, const Vec3d& way) {
  return of(turn_of(v), move_of(v) + cross(turn_of(v), way));
}

/// A force as a point that is `way` farther sees it.
Vec6 force_moved(const Vec6& f, const Vec3d& way) {
  return of(turn_of(f) - cross(way, move_of(f)), move_of(f));
}

/// X m X^T, where X takes columns along.
template <class Take>
Mat6 taken(const Mat6& m, const Take& take) {
  Mat6 half{};  // (X m)^T, column by column
  for (std::size_t k = 0; k < 6; ++k) {
    Vec6 column{};
    for (std::size_t i = 0; i < 6; ++i) {
      column[i] = m[i][k];
    }
    half[k] = take(column);
  }
  Mat6 result{};
  for (std::size_t i = 0; i < 6; ++i) {
    Vec6 row{};
    for (std::size_t k = 0; k < 6; ++k) {
      row[k] = half[k][i];
    }
    result[i] = take(row);
  }
  return result;
}

class Weights {
 public:
  Weights(mjModel& model, mjData& data) : m_(model), d_(data) {}

  bool find() {
    inertias_.assign(place(m_.nbody), {});
    composites_.assign(place(m_.nbody), {});
    axes_.assign(place(m_.nv), {});
    carried_.assign(place(m_.nv), {});
    pivots_.assign(place(m_.nv), 0);
    mass_.assign(place(m_.nv), 0);
    for (int b = 1; b < m_.nbody; ++b) {
      inertias_[place(b)] = own_inertia(b);
      composites_[place(b)] = inertias_[place(b)];
    }
    for (int b = static_cast<int>(m_.nbody) - 1; b > 0; --b) {
      if (!go_up(b)) {
        return false;
      }
    }
    inverse_.assign(place(m_.nv), 0);
    answers_.assign(place(m_.nbody), {});
    for (int b = 1; b < m_.nbody; ++b) {
      go_down(b);
    }
    return true;
  }

  void write() const {
    std::copy(mass_.begin(), mass_.end(), m_.dof_M0);
    m_.body_invweight0[0] = 0;
    m_.body_invweight0[1] = 0;
    for (int b = 1; b < m_.nbody; ++b) {
      write_body(b);
    }
    for (int j = 0; j < m_.njnt; ++j) {
      write_joint(j);
    }
  }

 private:
  Vec3d center(int body) const { return read_vector(d_.xipos + std::ptrdiff_t{3} * body); }
  Vec3d way_to_parent(int body) const { return center(m_.body_parentid[body]) - center(body); }

  Mat6 own_inertia(int body) const {
    const double* axes = d_.ximat + std::ptrdiff_t{9} * body;
    const double* moments = m_.body_inertia + std::ptrdiff_t{3} * body;
    Mat6 result{};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t n = 0; n < 3; ++n) {
          result[i][k] += axes[3 * i + n] * moments[n] * axes[3 * k + n];
        }
      }
      result[i + 3][i + 3] = m_.body_mass[body];
    }
    return result;
  }

  // MuJoCo's axes are about the centre of mass of the whole tree.
  Vec6 axis(int dof, int body) const {
    const double* column = d_.cdof + std::ptrdiff_t{6} * dof;
    const Vec3d origin = read_vector(d_.subtree_com + std::ptrdiff_t{3} * m_.body_rootid[body]);
    return moved(of(read_vector(column), read_vector(column + 3)), center(body) - origin);
  }

  bool go_up(int body) {
    Mat6& inertia = inertias_[place(body)];
    const int first = m_.body_dofadr[body];
    for (int i = first + m_.body_dofnum[body] - 1; i >= first && first >= 0; --i) {
      const Vec6 s = axis(i, body);
      const Vec6 u = times(inertia, s);
      const double pivot = dot6(s, u) + m_.dof_armature[i];
      if (!(pivot > mjMINVAL) || !std::isfinite(pivot)) {
        return false;
      }
      add_outer(inertia, u, u, -1 / pivot);
      axes_[place(i)] = s;
      carried_[place(i)] = u;
      pivots_[place(i)] = pivot;
      mass_[place(i)] = dot6(s, times(composites_[place(body)], s)) + m_.dof_armature[i];
    }
    const int parent = m_.body_parentid[body];
    if (parent > 0) {
      const Vec3d way = way_to_parent(body);
      const auto take = [&](const Vec6& force) { return force_moved(force, way); };
      add(inertias_[place(parent)], taken(inertia, take));
      add(composites_[place(parent)], taken(composites_[place(body)], take));
    }
    return true;
  }

  void go_down(int body) {
    const int parent = m_.body_parentid[body];
    const Vec3d way = -way_to_parent(body);
    Mat6 answer = parent == 0 ? Mat6{} : taken(answers_[place(parent)], [&](const Vec6& motion) {
      return moved(motion, way);
    });
    const int first = m_.body_dofadr[body];
    for (int i = first; i < first + m_.body_dofnum[body]; ++i) {
      const Vec6& s = axes_[place(i)];
      const Vec6& u = carried_[place(i)];
      const double pivot = pivots_[place(i)];
      inverse_[place(i)] = 1 / pivot + dot6(u, times(answer, u)) / (pivot * pivot);
      answer = taken(answer, [&](Vec6 motion) {
        const double share = dot6(u, motion) / pivot;
        for (std::size_t k = 0; k < 6; ++k) {
          motion[k] -= s[k] * share;
        }
        return motion;
      });
      add_outer(answer, s, s, 1 / pivot);
    }
    answers_[place(body)] = answer;
  }

  void write_body(int body) const {
    double* weight = m_.body_invweight0 + std::ptrdiff_t{2} * body;
    const Mat6& answer = answers_[place(body)];
    weight[0] = (answer[3][3] + answer[4][4] + answer[5][5]) / 3;
    weight[1] = (answer[0][0] + answer[1][1] + answer[2][2]) / 3;
    if (m_.body_dofnum[m_.body_weldid[body]] == 0) {
      weight[0] = 0;
      weight[1] = 0;
    } else if (m_.body_simple[body] == kSlidesAlone) {
      weight[0] = 1 / std::max(mjMINVAL, m_.body_mass[body]);
      weight[1] = 0;
    }
  }

  // A joint of several degrees of freedom has means: of slides and of turns.
  void write_joint(int joint) const {
    const int first = m_.jnt_dofadr[joint];
    if (m_.body_simple[m_.jnt_bodyid[joint]] == kSlidesAlone) {
      m_.dof_invweight0[first] = 1 / std::max(mjMINVAL, m_.body_mass[m_.jnt_bodyid[joint]]);
      return;
    }
    const int type = m_.jnt_type[joint];
    const int count = type == mjJNT_FREE ? 6 : type == mjJNT_BALL ? 3 : 1;
    const int together = std::min(count, 3);
    for (int i = first; i < first + count; i += together) {
      double mean = 0;
      for (int k = i; k < i + together; ++k) {
        mean += inverse_[place(k)] / together;
      }
      std::fill(m_.dof_invweight0 + i, m_.dof_invweight0 + i + together, mean);
    }
  }

  static constexpr int kSlidesAlone = 2;  // mjModel::body_simple of bodies that do not turn

  mjModel& m_;
  mjData& d_;
  std::vector<Mat6> inertias_;    // (nbody) of what hangs on it, its joints let go
  std::vector<Mat6> composites_;  // (nbody) of what hangs on it, its joints held
  std::vector<Vec6> axes_;        // (nv) S
  std::vector<Vec6> carried_;     // (nv) U
  std::vector<double> pivots_;    // (nv) D
  std::vector<double> mass_;      // (nv) diagonal of M
  std::vector<double> inverse_;   // (nv) diagonal of M^-1
  std::vector<Mat6> answers_;     // (nbody) W
};

bool any(const double* numbers, mjtSize count) {
  return std::any_of(numbers, numbers + count, [](double number) { return number != 0; });
}

/// One row of a sparse matrix.
struct SparseRow {
  int count = 0;
  const int* columns = nullptr;
  const double* numbers = nullptr;
};

/// M^-1 r
std::vector<double> solved(const mjModel& m, mjData& d, const SparseRow& row,
                           std::vector<double>& dense) {
  dense.assign(place(m.nv), 0);
  for (int k = 0; k < row.count; ++k) {
    dense[place(row.columns[k])] = row.numbers[k];
  }
  std::vector<double> result(dense.size());
  mj_solveM(&m, &d, result.data(), dense.data(), 1);
  return result;
}

void write_tendons_and_actuators(mjModel& m, mjData& d) {
  std::vector<double> row;
  for (int i = 0; i < m.ntendon; ++i) {
    const int at = m.ten_J_rowadr[i];
    const std::vector<double> answer =
        solved(m, d, {m.ten_J_rownnz[i], m.ten_J_colind + at, d.ten_J + at}, row);
    double weight = 0;
    for (std::size_t k = 0; k < row.size(); ++k) {
      weight += row[k] * answer[k];
    }
    m.tendon_invweight0[i] = weight;
  }
  for (int i = 0; i < m.nout; ++i) {
    const int at = d.moment_rowadr[i];
    const std::vector<double> answer =
        solved(m, d, {d.moment_rownnz[i], d.moment_colind + at, d.actuator_moment + at}, row);
    double squares = 0;
    for (const double number : answer) {
      squares += number * number;
    }
    m.actuator_acc0[i] = std::sqrt(squares);
  }
}

}  // namespace

bool set_inverse_weights(mjModel& model, mjData& data) {
  if (model.nflex != 0 || any(model.tendon_armature, model.ntendon) ||
      any(model.actuator_armature, model.nactuator)) {
    return false;
  }
  Weights weights(model, data);
  if (!weights.find()) {
    return false;
  }
  weights.write();
  mj_makeM(&model, &data);
  mj_factorM(&model, &data);
  write_tendons_and_actuators(model, data);
  return true;
}

}  // namespace tenon::engines::mujoco
