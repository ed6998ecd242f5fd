// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each kind of track has one function that brings its part of the scene to a time and says whether
// something changed. Switches go first, because nesting decides again what switched-off bodies hang
// on. A sample holds from its own time on; steps of a simulation add up to that time only roughly.
#include "tenon/scene/timeline/timeline.h"

#include <algorithm>
#include <string>
#include <utility>

#include "tenon/scene/fields/same_fields.h"
#include "tenon/scene/joint_freedom.h"
#include "tenon/scene/timeline/object_states.h"

namespace tenon::scene {
namespace {

constexpr double kSameTime = 1e-9;  // [s] a sample this much ahead counts already

// A joint side that moves by itself hangs on a kinematic body of its own (S-86).
PhysicsScene with_anchors(PhysicsScene scene) {
  for (PoseTrack& track : scene.pose_tracks) {
    if (!track.joint.has_value() || track.poses.empty()) {
      continue;
    }
    Joint& joint = scene.joints[*track.joint];
    Body anchor;
    anchor.path = joint.path.child(Token("anchor" + std::to_string(track.side)));
    anchor.kinematic = true;
    anchor.pose = track.poses.front();
    const std::optional<Index>& other = track.side == 0 ? joint.body1 : joint.body0;
    anchor.scene = other.has_value() ? scene.bodies[*other].scene : 0;
    const auto index = static_cast<Index>(scene.bodies.size());
    (track.side == 0 ? joint.body0 : joint.body1) = index;
    (track.side == 0 ? joint.frame0 : joint.frame1) = {};
    track.body = index;
    track.joint.reset();
    scene.bodies.push_back(anchor);
  }
  return scene;
}

bool has_object_tracks(const PhysicsScene& scene) {
  bool any = false;
  each_tracked_list([&](auto, auto tracks) { any = any || !(scene.*tracks).empty(); });
  return any;
}

bool is_on(const PhysicsScene& scene, const SwitchTrack& track) {
  switch (track.what) {
    case Switch::BodyEnabled:
      return scene.bodies[track.object].enabled;
    case Switch::BodyKinematic:
      return scene.bodies[track.object].kinematic;
    case Switch::ColliderEnabled:
      return scene.colliders[track.object].enabled;
    case Switch::JointEnabled:
      return scene.joints[track.object].enabled;
    case Switch::JointCollision:
      break;
  }
  return scene.joints[track.object].collision_enabled;
}

}  // namespace

bool Timeline::is_needed(const PhysicsScene& scene) {
  return !scene.switch_tracks.empty() || !scene.bounds_tracks.empty() ||
         !scene.gravity_tracks.empty() || !scene.shapes_tracks.empty() ||
         !scene.group_states.empty() || !scene.nesting_states.empty() || has_object_tracks(scene) ||
         std::any_of(scene.joints.begin(), scene.joints.end(), can_break) ||
         std::any_of(scene.pose_tracks.begin(), scene.pose_tracks.end(),
                     [](const PoseTrack& track) { return track.joint.has_value(); });
}

Timeline::Timeline(const PhysicsScene& scene, const BodyMass& massless)
    : scene_(with_anchors(scene)),
      nesting_(scene_, massless),
      broken_(scene_.joints.size(), 0),
      shape_states_(scene_.shapes_tracks.size(), 0) {
  // The scene may say other than the switches do: disabled bodies are kinematic.
  for (const SwitchTrack& track : scene_.switch_tracks) {
    switches_.push_back({&track, is_on(scene_, track)});
  }
}

SceneChange Timeline::advance(double seconds) {
  SceneChange change;
  follow_gravity(seconds);
  change.gravity = !scene_.gravity_tracks.empty();
  // Every one of them must run.
  const double now = seconds + kSameTime;
  const bool switched = follow_switches(now);
  const bool regrouped = follow_groups(now);
  follow_bounds(seconds);
  change.bounds = !scene_.bounds_tracks.empty();
  const bool set = follow_objects(now);
  const bool moved = follow_shapes(now);
  const bool nested = nesting_.apply(scene_, now);
  change.structure = switched || regrouped || set || moved || nested;
  return change;
}

void Timeline::hold_pose(Index body) {
  PoseTrack track;
  track.body = body;
  track.times = {0};
  track.poses = {scene_.bodies[body].pose};
  track.held = true;
  scene_.pose_tracks.push_back(std::move(track));
}

void Timeline::break_joint(Index joint) {
  scene_.joints[joint].enabled = false;
  broken_[joint] = 1;
}

std::vector<MergedBody> Timeline::restart(const std::vector<BodyState>& states) {
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
    Body& body = scene_.bodies[b];
    const BodyState& state = states[b];
    const bool moved = length(state.pose.position - body.pose.position) > 1e-9 ||
                       length(state.linear_velocity) + length(state.angular_velocity) > 1e-9;
    body.starts_asleep = body.starts_asleep && !moved;
    body.pose = state.pose;
    body.linear_velocity = state.linear_velocity;
    body.angular_velocity = state.angular_velocity;
  }
  for (Joint& joint : scene_.joints) {
    joint.initial_position.reset();
    joint.initial_velocity.reset();
  }
  std::vector<MergedBody> joined = nesting_.attach(scene_);
  scene_.update_joint_pairs();
  return joined;
}

void Timeline::set_switch(const SwitchTrack& track, bool on) {
  switch (track.what) {
    case Switch::BodyEnabled:
      scene_.bodies[track.object].enabled = on;
      break;
    case Switch::BodyKinematic:
      scene_.bodies[track.object].kinematic = on;
      break;
    case Switch::ColliderEnabled:
      scene_.colliders[track.object].enabled = on;
      break;
    case Switch::JointEnabled:
      scene_.joints[track.object].enabled = on && broken_[track.object] == 0;
      break;
    case Switch::JointCollision:
      scene_.joints[track.object].collision_enabled = on;
      break;
  }
}

bool Timeline::follow_switches(double seconds) {
  const bool changed =
      std::any_of(switches_.begin(), switches_.end(),
                  [&](const SwitchState& state) { return state.track->at(seconds) != state.on; });
  if (!changed) {
    return false;
  }
  for (SwitchState& state : switches_) {
    state.on = state.track->at(seconds);
    set_switch(*state.track, state.on);
  }
  for (const SwitchState& state : switches_) {  // what is disabled stands still
    if (state.track->what == Switch::BodyEnabled && !state.on) {
      scene_.bodies[state.track->object].kinematic = true;
    }
  }
  return true;
}

bool Timeline::follow_groups(double seconds) {
  const auto& states = scene_.group_states;
  std::size_t wanted = group_state_;
  while (wanted < states.size() && states[wanted].time <= seconds) {
    ++wanted;
  }
  if (wanted == group_state_) {
    return false;
  }
  group_state_ = wanted;
  CollisionFilter& filter = scene_.filter;
  const GroupState& state = states[wanted - 1];
  const bool changed =
      filter.group_pair_off != state.group_pair_off || filter.ungrouped_off != state.ungrouped_off;
  filter.group_pair_off = state.group_pair_off;
  filter.ungrouped_off = state.ungrouped_off;
  return changed;
}

void Timeline::follow_bounds(double seconds) {
  for (const BoundsTrack& track : scene_.bounds_tracks) {
    const JointBounds bounds = track.at(seconds);
    Joint& joint = scene_.joints[track.joint];
    joint.lower = bounds.lower;
    joint.upper = bounds.upper;
    joint.cone_angle0 = bounds.cone_angle0;
    joint.cone_angle1 = bounds.cone_angle1;
    joint.limits = bounds.limits;
  }
}

// S-37: shapes that move inside bodies, and the mass that moves with them. The body moves on as it
// did: a simulation gives restart() the velocity of the new centre of mass.
bool Timeline::follow_shapes(double seconds) {
  bool moved = false;
  for (std::size_t i = 0; i < scene_.shapes_tracks.size(); ++i) {
    const ShapesTrack& track = scene_.shapes_tracks[i];
    const std::size_t wanted = track.at(seconds);
    if (wanted == shape_states_[i] || wanted >= track.shapes.size()) {
      continue;
    }
    shape_states_[i] = wanted;
    moved = true;
    const BodyShapes& now = track.shapes[wanted];
    for (std::size_t k = 0; k < track.colliders.size(); ++k) {
      scene_.colliders[track.colliders[k]].pose = now.poses[k];
      scene_.colliders[track.colliders[k]].shape = now.shapes[k];
    }
    Body& body = scene_.bodies[track.body];
    body.mass = now.mass;
    body.center_of_mass = now.center_of_mass;
    body.inertia = now.inertia;
  }
  return moved;
}

namespace {

template <class Object>
bool asks_for_another_model(const Object&, const Object&) {
  return true;
}
// The limits at which joints break are read at every step.
bool asks_for_another_model(const Joint& before, const Joint& after) {
  Joint same_limits = after;
  same_limits.break_force = before.break_force;
  same_limits.break_torque = before.break_torque;
  return can_break(before) != can_break(after) || !same_fields(before, same_limits);
}

}  // namespace

template <class Object>
bool Timeline::follow_objects(const std::vector<ObjectTrack<Object>>& tracks,
                              std::vector<Object>& objects, double seconds) {
  bool changed = false;
  for (const ObjectTrack<Object>& track : tracks) {
    const auto after = std::upper_bound(track.times.begin(), track.times.end(), seconds);
    if (after == track.times.begin() || *(after - 1) <= objects_at_) {
      continue;
    }
    Object next = track.states[static_cast<std::size_t>(after - track.times.begin()) - 1];
    Object& now = objects[track.object];
    keep_followed(scene_, track.object, now, next);
    changed = asks_for_another_model(now, next) || changed;
    now = std::move(next);
  }
  return changed;
}

bool Timeline::follow_objects(double seconds) {
  bool changed = false;
  each_tracked_list([&](auto objects, auto tracks) {
    changed = follow_objects(scene_.*tracks, scene_.*objects, seconds) || changed;
  });
  objects_at_ = seconds;
  return changed;
}

void Timeline::follow_gravity(double seconds) {
  for (const GravityTrack& track : scene_.gravity_tracks) {
    scene_.scenes[track.scene].gravity = track.at(seconds);
  }
}

}  // namespace tenon::scene
