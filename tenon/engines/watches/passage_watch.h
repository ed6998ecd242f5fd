// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "tenon/engines/input_log.h"
#include "tenon/engines/simulation.h"

/// Bodies so fast that they pass through others between two steps, on engines that do not tell.
namespace tenon::engines {

/// Looks at bodies on no joint. One that comes to move by more than half of its thinnest side in a
/// step is found within eight steps, 32 where none came near that speed before, and is looked at in
/// each from then on.
class PassageWatch {
 public:
  /// What was set from outside, which moves bodies outside of steps.
  void note(const Input& input);
  /// Before a step.
  void begin(const Simulation& simulation, const scene::PhysicsScene& scene);
  /// After it: what was passed; each pair once.
  std::vector<Event> end(const Simulation& simulation, const scene::PhysicsScene& scene);

 private:
  struct Watched {
    scene::Index body = 0;
    scene::Index collider = 0;  ///< one of the body's
    double way = 0;             ///< half of the thinnest side [m]; farther in a step is fast
    bool fast = false;
    Vec3d center{};  ///< of a fast one, after the step before, world [m]
  };
  void list_bodies(const scene::PhysicsScene& scene);
  void look_for_fast(const Simulation& simulation);
  /// A body that is behind a collider; the contact may still push it back.
  struct Passage {
    scene::Index body = 0;
    scene::Index collider = 0;
    Vec3d from;  ///< centre of mass before the step, world [m]; moves along with the collider
    Event event;
    int steps = 0;  ///< since then
  };
  void look_along(const Simulation& simulation, const scene::PhysicsScene& scene,
                  const Watched& watched, const Vec3d& to);
  bool is_between(const Simulation& simulation, const scene::PhysicsScene& scene,
                  scene::Index collider, const Vec3d& from, const Vec3d& to) const;

  std::vector<Watched> bodies_;
  std::vector<std::size_t> fast_;  ///< into bodies_
  std::vector<double> radii_;      ///< of balls about the colliders [m] (collider_count)
  std::vector<Passage> open_;
  std::vector<std::pair<scene::Index, scene::Index>> told_;  ///< body and collider
  std::size_t steps_ = 0;
  std::size_t next_look_ = 0;  ///< at all bodies, in steps
  bool fresh_ = true;          ///< nothing is known of where bodies were
};

/// The event of a body that passed a collider within a step in which it moved by `way` [m].
Event passage_event(const scene::PhysicsScene& scene, double time, scene::Index body,
                    scene::Index collider, double way);

}  // namespace tenon::engines
