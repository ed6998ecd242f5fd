// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "tenon/scene/body_state.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/scene/timeline/body_nesting.h"

namespace tenon::scene {

/// What Timeline::advance() changed.
struct SceneChange {
  /// Bodies, colliders, joints, filters, shapes, masses or settings: an engine rebuilds its model.
  bool structure = false;
  bool gravity = false;  ///< maybe; of any scene
  bool bounds = false;   ///< maybe; of the joints of PhysicsScene::bounds_tracks
};

/// A scene as it is at a time: what its asset switches, bounds, weighs, filters, moves inside
/// bodies, sets and nests by time samples (S-23, S-28, S-37, S-91), and which joints broke. For
/// every engine the same; drive targets and the poses of kinematic bodies and static colliders,
/// which engines write at every step, they read from the tracks.
class Timeline {
 public:
  /// False for most scenes: nothing but tracks of drives and poses, so that no Timeline is needed.
  static bool is_needed(const PhysicsScene& scene);

  /// At 0 s. The scene gets kinematic bodies at joint sides that move by themselves (S-86) and
  /// joints that hold nested bodies, both behind those that it has. `massless`: see BodyNesting.
  explicit Timeline(const PhysicsScene& scene, const BodyMass& massless = {});
  Timeline(const Timeline&) = delete;
  Timeline& operator=(const Timeline&) = delete;

  /// As it is now. It stays where it is in memory.
  const PhysicsScene& scene() const { return scene_; }

  /// Brings the scene to a time [s], which never goes back.
  SceneChange advance(double seconds);
  /// Keeps a kinematic body in place until an engine moves it: it gets a track of one pose.
  void hold_pose(Index body);
  /// For good: no switch makes it whole again (S-93).
  void break_joint(Index joint);
  /// What a simulation reached (body_count) becomes the start of the scene, so that a model can be
  /// made from it in the middle of a run. Gives bodies that became parts of others since the last
  /// call: they bring their momentum along.
  std::vector<MergedBody> restart(const std::vector<BodyState>& states);

 private:
  struct SwitchState {
    const SwitchTrack* track = nullptr;
    bool on = false;
  };
  void set_switch(const SwitchTrack& track, bool on);
  bool follow_switches(double seconds);
  bool follow_groups(double seconds);
  bool follow_shapes(double seconds);
  bool follow_objects(double seconds);
  template <class Object>
  bool follow_objects(const std::vector<ObjectTrack<Object>>& tracks, std::vector<Object>& objects,
                      double seconds);
  void follow_bounds(double seconds);
  void follow_gravity(double seconds);

  PhysicsScene scene_;
  BodyNesting nesting_;
  std::vector<SwitchState> switches_;
  std::vector<char> broken_;               ///< (joint_count)
  std::size_t group_state_ = 0;            ///< into group_states, plus one; 0: as at the start
  std::vector<std::size_t> shape_states_;  ///< sample in force (shapes_track_count)
  double objects_at_ = -kUnlimited;        ///< [s] that object tracks were brought to
};

}  // namespace tenon::scene
