// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/engines/mujoco/model.h"
#include "tenon/engines/watches/spring_energy.h"

namespace tenon::engines::mujoco {

/// Watches whether the energy of a model grows although nothing gives any.
class EnergyWatch {
 public:
  struct Growth {
    double energy = 0;       ///< kinetic, at the end of the step [J]
    double unexplained = 0;  ///< of what was gained, the part that nothing gave [J]
    int body = 0;            ///< MuJoCo body that moves with the largest part of it
  };

  EnergyWatch() = default;
  EnergyWatch(const scene::PhysicsScene& scene, const Model& model);

  /// State or numbers were changed from outside: start again with the next step.
  void restart() { fresh_ = true; }
  /// Before MuJoCo advances, when all inputs are written. `pushed`: the forces of this step differ
  /// from those at the last start.
  void begin(const Model& model, bool pushed);
  /// After it has and speeds are cut, before anything else is derived or written. A value: nothing
  /// explains the energy; derive_motion() has run then.
  std::optional<Growth> end(const Model& model);

 private:
  /// A drive towards a position: a spring that some work has stretched, and a damper.
  struct Spring {
    int actuator = 0;
    int control = 0;  ///< of its position target; that of its velocity comes next
    int qpos = 0;
    int dof = 0;
    DriveSpring drive;
  };
  void give(double work);
  void read_springs(const Model& model);
  void set_baseline(const Model& model);
  void follow_targets(const Model& model);
  void add_work(const Model& model);
  double work_of(const double* forces, const Model& model) const;
  double work_from_outside(const Model& model) const;
  double work_of_other_drives(const Model& model) const;
  double work_of_contacts(const Model& model) const;
  double work_of_driven(const Model& model) const;
  double kinetic_energy(const Model& model, const double* velocity);
  double potential_energy(const Model& model) const;
  std::optional<Growth> judge(const Model& model);

  std::vector<std::size_t> candidates_;  ///< drives that may be springs, into Model::drives
  std::vector<Spring> springs_;
  bool only_springs_ = false;  ///< no actuator is anything else
  bool pushed_ = true;         ///< forces from outside may have begun in the step under way
  bool outside_ = true;        ///< some have acted since the baseline
  std::vector<int> driven_;    ///< first of six coordinates of bodies that follow poses
  std::vector<int> driven_bodies_;
  bool moved_ = false;  ///< something follows poses or bounds: constraints may give energy
  std::vector<double> controls_;   ///< that springs' targets are (control count)
  std::vector<double> velocity_;   ///< at the beginning of the step (dof_count)
  std::vector<double> positions_;  ///< at the beginning of the first one (nq)
  std::vector<double> scratch_;    ///< (dof_count)
  int between_ = 1;                ///< steps from one judgement to the next
  int steps_ = 0;
  bool fresh_ = true;
  double start_ = 0;  ///< energy at the baseline, springs included [J]
  double scale_ = 0;  ///< what moves about in the scene by nature [J]
  double lowest_ = 0;
  double highest_ = 0;    ///< potential energy since the baseline
  double explained_ = 0;  ///< work that drives, contacts and the like have done since then [J]
  double gained_ = 0;     ///< the positive part of it
  double lost_ = 0;       ///< the negative part, >= 0
};

}  // namespace tenon::engines::mujoco
