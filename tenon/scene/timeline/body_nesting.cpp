// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/timeline/body_nesting.h"

#include <algorithm>
#include <map>

namespace tenon::scene {
namespace {

std::size_t state_at(const std::vector<NestingState>& states, double time) {
  std::size_t at = 0;
  while (at + 1 < states.size() && states[at + 1].time <= time) {
    ++at;
  }
  return at;
}

}  // namespace

BodyNesting::BodyNesting(PhysicsScene& scene, const BodyMass& massless) : massless_(massless) {
  std::map<Index, BodyMass> masses;
  std::map<Index, Index> joints;
  for (const NestingState& state : scene.nesting_states) {
    for (const MergedBody& merged : state.merged) {
      joints.emplace(merged.body, 0);
    }
    for (const auto& [index, mass] : state.masses) {
      const Body& body = scene.bodies[index];
      masses.emplace(index, BodyMass{body.mass, body.center_of_mass, body.inertia});
    }
  }
  own_masses_.assign(masses.begin(), masses.end());
  for (const auto& [body, unused] : joints) {
    Joint joint;
    joint.path = scene.bodies[body].path.property(Token("merged"));  // the path of no prim
    joint.kind = JointKind::Fixed;
    joint.body1 = body;
    joint.enabled = false;
    bodies_.push_back({body, static_cast<Index>(scene.joints.size())});
    scene.joints.push_back(std::move(joint));
  }
  if (!bodies_.empty()) {
    apply(scene, 0);
    attach(scene);
  }
}

void BodyNesting::set_mass(Body& body, const BodyMass& mass) const {
  const BodyMass& given = mass.mass > 0 ? mass : massless_;
  body.mass = given.mass;
  body.center_of_mass = mass.center_of_mass;
  body.inertia = given.inertia;
}

bool BodyNesting::apply(PhysicsScene& scene, double time) {
  if (bodies_.empty()) {
    return false;
  }
  const std::size_t now = state_at(scene.nesting_states, time);
  const bool changed = now != state_;
  state_ = now;
  const NestingState& state = scene.nesting_states[now];
  for (NestedBody& nested : bodies_) {
    merge(scene, nested, state.merged);
  }
  if (changed) {
    for (const auto& [body, mass] : own_masses_) {
      set_mass(scene.bodies[body], mass);
    }
    for (const auto& [body, mass] : state.masses) {
      set_mass(scene.bodies[body], mass);
    }
  }
  return changed;
}

void BodyNesting::merge(PhysicsScene& scene, NestedBody& nested,
                        const std::vector<MergedBody>& merged) {
  const auto found = std::find_if(merged.begin(), merged.end(), [&](const MergedBody& entry) {
    return entry.body == nested.body;
  });
  const bool on_it = nested.merged;
  nested.merged = found != merged.end();
  if (nested.merged) {
    nested.fresh = nested.fresh || !on_it || nested.into != found->into;
    nested.into = found->into;
    scene.bodies[nested.body].kinematic = false;
  }
  Joint& joint = scene.joints[nested.joint];
  joint.enabled = nested.merged;
  joint.body0 = nested.merged ? std::optional(nested.into) : std::nullopt;
}

std::vector<MergedBody> BodyNesting::attach(PhysicsScene& scene) {
  std::vector<MergedBody> attached;
  for (NestedBody& nested : bodies_) {
    if (nested.merged && nested.fresh) {
      scene.joints[nested.joint].frame0 =
          inverse(scene.bodies[nested.into].pose) * scene.bodies[nested.body].pose;
      attached.push_back({nested.body, nested.into});
    }
    nested.fresh = false;
  }
  return attached;
}

}  // namespace tenon::scene
