// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/engines/input_log.h"
#include "tenon/engines/steering.h"

namespace tenon::engines {

/// Finds runs that gain energy from nowhere, on any engine: it reads states and inputs alone, every
/// few steps, and bounds what the inputs can have given. MuJoCo, which tells the force of
/// everything, has an account instead (mujoco/run/energy_watch.h).
class EnergyBound {
 public:
  EnergyBound() = default;
  explicit EnergyBound(double time_step);

  /// Something was set: targets move, and states and parameters are a new start.
  void note(const Input& input);

  /// Before a step.
  void begin(const Simulation& simulation, const scene::PhysicsScene& scene,
             const Steering& steering);
  /// After it. Errors: Unstable (rule `rule`), with the body that moves most.
  Result<void> end(const Simulation& simulation, const scene::PhysicsScene& scene,
                   const Steering& steering, std::string_view rule);

 private:
  /// A drive, and what its target did since the last look.
  struct Driven {
    scene::Index joint = 0;
    scene::Index drive = 0;
    std::size_t coordinate = 0;  ///< into JointState
    double lower = 0;            ///< of the coordinate [m or rad]
    double upper = 0;
    double inertia = 1;  ///< of drives by acceleration: at most what it moves [kg, kg m^2]
    double target = 0;
    double moved = 0;   ///< length of the way of the target [m or rad]
    double pull = 0;    ///< force at the last look [N or N m]
    double stored = 0;  ///< energy of the spring at the last look [J]
  };
  void set_baseline(const Simulation& simulation, const scene::PhysicsScene& scene,
                    const Steering& steering);
  void list_drives(const scene::PhysicsScene& scene);
  void look(const Simulation& simulation, const scene::PhysicsScene& scene,
            const Steering& steering, double span);
  void look_at_drives(const Simulation& simulation, const scene::PhysicsScene& scene,
                      const Steering& steering, double span);
  void look_at_forces(const Simulation& simulation, const scene::PhysicsScene& scene,
                      const Steering& steering, double span);
  void look_at_moved(const Simulation& simulation, const scene::PhysicsScene& scene, double span);

  double time_step_ = 0;
  std::size_t between_ = 1;  ///< steps from one look to the next
  std::size_t steps_ = 0;
  std::size_t looked_ = 0;  ///< step of the last look
  bool fresh_ = true;
  std::vector<Driven> drives_;
  std::vector<std::size_t> first_;  ///< of a joint, into drives_ (joint_count)
  double scale_ = 0;                ///< what moves about in the scene by nature [J]
  double extent_ = 0;               ///< [m]
  double mass_ = 0;                 ///< that can move [kg]
  double carried_ = 0;              ///< largest speed of what follows poses [m/s]
  double start_ = 0;                ///< energy at the baseline, springs of drives included [J]
  double stored_ = 0;               ///< in those springs now [J]
  double given_ = 0;                ///< at most, by inputs since the baseline [J]
  double lowest_ = 0;               ///< potential energy since the baseline [J]
  double highest_ = 0;
};

}  // namespace tenon::engines
