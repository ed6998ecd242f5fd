// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Everything that is read from attributes at the start is read the same way at each later sample;
// its findings were reported at the start.
#include "tenon/physics/switches.h"

#include "tenon/physics/joints/joint_limits.h"
#include "tenon/physics/sample_codes.h"
#include "tenon/physics/scenes.h"

namespace tenon::physics {
namespace {

class SwitchReader {
 public:
  explicit SwitchReader(ReadState& state)
      : state_(state), held_(state.readings.held_samples == HeldSamples::Held) {}

  void run() {
    const PhysicsTokens& tokens = state_.tokens;
    for (Index i = 0; i < state_.scene.bodies.size(); ++i) {
      add(state_.prim_of_body(i).prim, tokens.body_enabled, true, Switch::BodyEnabled, i);
      add_kinematic(i);
    }
    for (Index i = 0; i < state_.scene.colliders.size(); ++i) {
      add(state_.prim_of_collider(i).prim, tokens.collision_enabled, true, Switch::ColliderEnabled,
          i);
    }
    for (Index i = 0; i < state_.scene.joints.size(); ++i) {
      const stage::Prim& prim = state_.prim_of_joint(i).prim;
      add(prim, tokens.joint_enabled, true, Switch::JointEnabled, i);
      add(prim, tokens.collision_enabled, false, Switch::JointCollision, i);
      add_bounds(i);
    }
    for (Index i = 0; i < state_.scene.scenes.size(); ++i) {
      add_gravity(i);
    }
  }

 private:
  void add(const stage::Prim& prim, Token name, bool fallback, Switch what, Index object) {
    const stage::Attribute attribute = prim.attribute(name);
    if (!attribute.is_animated()) {
      return;
    }
    state_.follow(prim, name);
    SwitchTrack track{what, object, {}, {}};
    for (const double code : attribute.time_samples()) {
      track.times.push_back(state_.seconds(code));
      const bool on = attribute.get_as<bool>(stage::Time(code)).value_or(fallback);
      track.values.push_back(on ? 1 : 0);
    }
    if (!track.times.empty()) {
      state_.scene.switch_tracks.push_back(std::move(track));
    }
  }

  /// A body that is enabled later has to know whether it is kinematic then.
  void add_kinematic(Index i) {
    const stage::Prim& prim = state_.prim_of_body(i).prim;
    const Token name = state_.tokens.kinematic;
    add(prim, name, false, Switch::BodyKinematic, i);
    if (prim.attribute(state_.tokens.body_enabled).is_animated() &&
        !prim.attribute(name).is_animated()) {
      const bool on = prim.attribute(name).get_as<bool>(state_.values.start()).value_or(false);
      state_.scene.switch_tracks.push_back(
          {Switch::BodyKinematic, i, {0}, {static_cast<char>(on ? 1 : 0)}});
    }
  }

  /// Times of samples of any of these attributes; none when they do not vary.
  std::vector<double> codes_of(const stage::Prim& prim, const std::vector<Token>& names) {
    std::vector<stage::Attribute> animated;
    for (const Token name : names) {
      animated.push_back(prim.attribute(name));
      if (animated.back().is_animated()) {
        state_.follow(prim, name);
      } else {
        animated.pop_back();
      }
    }
    return sample_codes(animated);
  }

  void add_bounds(Index i) {
    const PhysicsPrim& found = state_.prim_of_joint(i);
    const PhysicsTokens& tokens = state_.tokens;
    std::vector<Token> names{tokens.lower_limit, tokens.upper_limit,  tokens.cone_angle0,
                             tokens.cone_angle1, tokens.min_distance, tokens.max_distance};
    if (found.roles.has(Api::Limit)) {
      for (const Token& instance : found.prim.api_instances("PhysicsLimitAPI")) {
        names.emplace_back("limit:" + instance.str() + ":physics:low");
        names.emplace_back("limit:" + instance.str() + ":physics:high");
      }
    }
    BoundsTrack track{i, {}, {}, held_};
    for (const double code : codes_of(found.prim, names)) {
      Diagnostics silent;
      const ReadState later = state_.at(code, silent);
      Joint joint;
      joint.kind = state_.scene.joints[i].kind;
      joint.axis = state_.scene.joints[i].axis;
      read_joint_limits(later, found, joint);
      track.times.push_back(state_.seconds(code));
      track.bounds.push_back({joint.lower, joint.upper, joint.cone_angle0, joint.cone_angle1,
                              std::move(joint.limits)});
    }
    if (!track.times.empty()) {
      state_.scene.bounds_tracks.push_back(std::move(track));
    }
  }

  void add_gravity(Index i) {
    const PhysicsPrim* found = state_.walk.find(state_.scene.scenes[i].path);
    if (found == nullptr) {
      return;
    }
    GravityTrack track{i, {}, {}, held_};
    const std::vector<Token> names{state_.tokens.gravity_direction, state_.tokens.gravity_magnitude,
                                   state_.tokens.newton_gravity_enabled};
    for (const double code : codes_of(found->prim, names)) {
      Diagnostics silent;
      track.times.push_back(state_.seconds(code));
      track.gravity.push_back(scene_gravity(state_.at(code, silent), *found));
    }
    if (!track.times.empty()) {
      state_.scene.gravity_tracks.push_back(std::move(track));
    }
  }

  ReadState& state_;
  bool held_;
};

}  // namespace

void read_switches(ReadState& state) { SwitchReader(state).run(); }

}  // namespace tenon::physics
