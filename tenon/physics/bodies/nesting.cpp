// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Bodies inside bodies that samples switch off (S-23): their colliders then belong to the nearest
// body around them that is on. Whenever such a switch moves, the stage is walked and weighed once
// more, with what is off as no body; what that says of membership and mass is kept.
#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "tenon/base/limits/physics_limits.h"
#include "tenon/math/inertia.h"
#include "tenon/physics/bodies/bodies_with_mass.h"
#include "tenon/physics/bodies/mass_properties.h"
#include "tenon/physics/provenance.h"
#include "tenon/physics/read_state.h"
#include "tenon/physics/sample_codes.h"

namespace tenon::physics {
namespace {

BodyMass body_mass_of(const MassProperties& properties) {
  return {properties.mass, properties.center, properties.inertia};
}

class NestingReader {
 public:
  explicit NestingReader(ReadState& state) : state_(state) {}

  void run() {
    find_nested();
    std::vector<char> before;
    for (const double code : codes()) {
      const std::vector<char> on = flags(code);
      if (on == before) {
        continue;
      }
      if (state_.scene.nesting_states.size() == limits::kNestingStates) {
        note_limit(code);
        return;
      }
      before = on;
      add_state(code);
    }
  }

 private:
  bool is_switched(const PhysicsPrim& found) const {
    return found.prim.attribute(state_.tokens.body_enabled).is_animated();
  }

  /// Bodies with a switch below others, and the bodies around them that have one.
  void find_nested() {
    for (Index i = 0; i < state_.scene.bodies.size(); ++i) {
      const PhysicsPrim& found = state_.prim_of_body(i);
      if (found.outer_body == kNone || !is_switched(found)) {
        continue;
      }
      nested_.push_back(i);
      switched_.push_back(state_.body_prims[i]);
      for (std::uint32_t at = found.outer_body; at != kNone;
           at = state_.walk.prims[at].outer_body) {
        if (is_switched(state_.walk.prims[at])) {
          switched_.push_back(at);
        }
      }
    }
    std::sort(switched_.begin(), switched_.end());
    switched_.erase(std::unique(switched_.begin(), switched_.end()), switched_.end());
  }

  std::vector<double> codes() const {
    std::vector<stage::Attribute> switches;
    for (const std::uint32_t at : switched_) {
      switches.push_back(state_.walk.prims[at].prim.attribute(state_.tokens.body_enabled));
    }
    return sample_codes(switches);
  }

  std::vector<char> flags(double code) const {
    std::vector<char> on;
    for (const std::uint32_t at : switched_) {
      const stage::Attribute enabled =
          state_.walk.prims[at].prim.attribute(state_.tokens.body_enabled);
      on.push_back(enabled.get_as<bool>(stage::Time(code)).value_or(true) ? 1 : 0);
    }
    return on;
  }

  void note_limit(double code) {
    state_.not_read(state_.prim_of_body(nested_.front()).prim, state_.tokens.body_enabled.str(),
                    "switches of bodies inside bodies from time code " + std::to_string(code) +
                        " on are more than the limit");
  }

  void add_state(double code) {
    Diagnostics silent;
    Provenance all;
    ReadState then = state_.at(state_.scene.start_time_code, silent);
    then.mesh_tools = state_.mesh_tools;
    then.integrals = state_.integrals;
    then.provenance = &all;
    then.walk = walk_stage(state_.stage, then.values, state_.readings, stage::Time(code));
    read_bodies_with_mass(then);

    NestingState found;
    found.time = state_.seconds(code);
    std::map<Index, std::vector<Index>> merged_into;
    for (const Index body : nested_) {
      const PhysicsPrim* prim = then.walk.find(state_.scene.bodies[body].path);
      const bool is_merged = prim != nullptr && !prim->is_body && prim->body != kNone;
      const std::optional<Index> carrier =
          is_merged ? body_at(state_, then.walk.prims[prim->body].path) : std::nullopt;
      if (carrier) {
        found.merged.push_back({body, *carrier});
        merged_into[*carrier].push_back(body);
      }
    }
    for (const auto& [carrier, merged] : merged_into) {
      const auto there = body_at(then, state_.scene.bodies[carrier].path);
      const auto provenance =
          std::find_if(all.masses.begin(), all.masses.end(),
                       [&](const MassProvenance& one) { return one.body == there; });
      if (provenance != all.masses.end()) {
        share_mass(*provenance, then.scene, carrier, merged, found);
      }
    }
    std::sort(found.masses.begin(), found.masses.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    state_.scene.nesting_states.push_back(std::move(found));
  }

  static std::optional<Index> body_at(const ReadState& state, Path path) {
    const std::uint32_t body = state.body_at(path);
    return body == kNone ? std::nullopt : std::optional<Index>(body);
  }

  /// Whose collider it is while everything is on; kNone of what does not collide then, as a plane
  /// inside a body that moves.
  Index owner_of(Path collider) const {
    const std::uint32_t i = state_.collider_at(collider);
    return i == kNone ? kNone : state_.scene.colliders[i].body.value_or(kNone);
  }

  /// Each part gets what its own colliders weigh; all of it is the carrier's where its mass API
  /// says more than a density.
  void share_mass(const MassProvenance& provenance, const PhysicsScene& then, Index carrier,
                  const std::vector<Index>& merged, NestingState& found) const {
    const bool whole = provenance.authored.mass || provenance.authored.center ||
                       provenance.authored.inertia || !(provenance.computed.mass > 0);
    std::map<Index, std::vector<MassProperties>> parts;
    for (const ColliderMass& part : provenance.colliders) {
      if (part.counted) {
        parts[owner_of(then.colliders[part.collider].path)].push_back(part.properties);
      }
    }
    const Pose& frame = state_.scene.bodies[carrier].pose;
    found.masses.emplace_back(carrier,
                              body_mass_of(whole ? provenance.result : sum_masses(parts[carrier])));
    for (const Index body : merged) {
      MassProperties own;
      if (!whole) {
        own = in_frame(sum_masses(parts[body]), inverse(state_.scene.bodies[body].pose) * frame);
      }
      found.masses.emplace_back(body, body_mass_of(own));
    }
  }

  static MassProperties in_frame(MassProperties part, const Pose& to_frame) {
    part.center = to_frame.position + rotate(to_frame.orientation, part.center);
    part.inertia = rotate_inertia(to_frame.orientation, part.inertia);
    return part;
  }

  ReadState& state_;
  std::vector<Index> nested_;            // bodies
  std::vector<std::uint32_t> switched_;  // into walk.prims
};

}  // namespace

void read_nesting(ReadState& state) {
  if (state.values.stage_is_animated()) {
    NestingReader(state).run();
  }
}

}  // namespace tenon::physics
