// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "tenon/engines/mujoco/model.h"

namespace tenon::engines::mujoco {

/// How velocities are cut where equalities such as mimics and loops hold: they answer an impulse
/// with impulses of their own, so that what they tie changes together.
class EqualityMotion {
 public:
  EqualityMotion() = default;
  explicit EqualityMotion(const mjModel& m);

  /// Before a step.
  void begin(const mjData& d);
  /// After it: equalities are taken as it had them, once they are asked for.
  void end_step();
  /// Other velocities are cut: nothing of them is restored yet.
  void restart();
  /// Whether equalities act on the kinematic tree of a degree of freedom.
  bool tie(int dof) const { return group_of_[static_cast<std::size_t>(dof)] >= 0; }
  /// The degrees of freedom that equalities tie to one that they act on, itself included.
  const std::vector<int>& tied_to(int dof) const { return group(dof).dofs; }
  /// Gives velocities of the trees tied to `dof` the rates that equalities ask for: a strong drive
  /// has pulled at them with a force that the cut takes away. False where that is done already, or
  /// there are none.
  bool restore(int dof, const mjModel& m, mjData& d);
  /// Adds to a change of velocities (dof_count) what the equalities on the trees tied to `dof`
  /// answer.
  void answer(int dof, const mjModel& m, mjData& d, double* change);

 private:
  /// One equality, orthogonal to those before it; both along the group's degrees of freedom.
  struct Row {
    std::vector<double> along;     ///< of the Jacobian
    std::vector<double> response;  ///< velocities after a unit impulse
    double product = 0;            ///< of the two
    double rate = 0;               ///< that it asks for
  };
  struct Group {
    std::vector<int> dofs;
    std::vector<Row> rows;  ///< the first `count` are of this step
    std::size_t count = 0;
    bool made = false;
    bool restored = false;
  };
  const Group& group(int dof) const {
    return groups_[static_cast<std::size_t>(group_of_[static_cast<std::size_t>(dof)])];
  }
  /// The group of a degree of freedom with its rows; nullptr without equalities.
  Group* made_group(int dof, const mjModel& m, mjData& d);
  /// That of row `number` of the constraints, whose Jacobian has been read.
  void add_row(Group& group, int number, const mjModel& m, mjData& d);

  std::vector<int> group_of_;  ///< (dof_count), -1: no equality
  std::vector<Group> groups_;
  std::vector<double> jacobian_;  ///< scratch (dof_count)
  std::vector<double> response_;  ///< scratch (dof_count)
  std::vector<double> start_;     ///< velocities before the step (dof_count)
};

}  // namespace tenon::engines::mujoco
