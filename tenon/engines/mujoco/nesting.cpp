// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/nesting.h"

#include <algorithm>
#include <map>

#include "tenon/engines/mujoco/least_inertia.h"
#include "tenon/math/inertia.h"

namespace tenon::engines::mujoco {
namespace {

using physics::BodyMass;
using physics::CarriedBody;
using physics::Index;
using physics::NestingState;
using physics::PhysicsScene;

std::size_t state_at(const std::vector<NestingState>& states, double time) {
  std::size_t at = 0;
  while (at + 1 < states.size() && states[at + 1].time <= time) {
    ++at;
  }
  return at;
}

void set_mass(physics::Body& body, const BodyMass& mass) {
  body.mass = mass.mass;
  body.center_of_mass = mass.center_of_mass;
  body.inertia = mass.inertia;
  if (!(mass.mass > 0)) {
    body.mass = kLeastMass;
    body.inertia = {};
    for (std::size_t i = 0; i < 3; ++i) {
      body.inertia[i][i] = kLeastMoment;
    }
  }
}

}  // namespace

BodyNesting::BodyNesting(PhysicsScene& scene) {
  std::map<Index, BodyMass> masses;
  std::map<Index, Index> joints;
  for (const NestingState& state : scene.nesting_states) {
    for (const CarriedBody& carried : state.carried) {
      joints.emplace(carried.body, 0);
    }
    for (const auto& [index, mass] : state.masses) {
      const physics::Body& body = scene.bodies[index];
      masses.emplace(index, BodyMass{body.mass, body.center_of_mass, body.inertia});
    }
  }
  own_masses_.assign(masses.begin(), masses.end());
  for (const auto& [body, unused] : joints) {
    physics::Joint joint;
    joint.path = scene.bodies[body].path.property(Token("carried"));  // the path of no prim
    joint.kind = physics::JointKind::Fixed;
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

bool BodyNesting::apply(PhysicsScene& scene, double time) {
  if (bodies_.empty()) {
    return false;
  }
  const std::size_t now = state_at(scene.nesting_states, time);
  const bool changed = now != state_;
  state_ = now;
  const NestingState& state = scene.nesting_states[now];
  for (NestedBody& nested : bodies_) {
    carry(scene, nested, state.carried);
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

void BodyNesting::carry(PhysicsScene& scene, NestedBody& nested,
                        const std::vector<CarriedBody>& carried) {
  const auto found = std::find_if(carried.begin(), carried.end(), [&](const CarriedBody& entry) {
    return entry.body == nested.body;
  });
  const bool on_it = nested.carried;
  nested.carried = found != carried.end();
  if (nested.carried) {
    nested.fresh = nested.fresh || !on_it || nested.carrier != found->carrier;
    nested.carrier = found->carrier;
    scene.bodies[nested.body].kinematic = false;
  }
  physics::Joint& joint = scene.joints[nested.joint];
  joint.enabled = nested.carried;
  joint.body0 = nested.carried ? std::optional(nested.carrier) : std::nullopt;
}

std::vector<CarriedBody> BodyNesting::attach(PhysicsScene& scene) {
  std::vector<CarriedBody> attached;
  for (NestedBody& nested : bodies_) {
    if (nested.carried && nested.fresh) {
      scene.joints[nested.joint].frame0 =
          inverse(scene.bodies[nested.carrier].pose) * scene.bodies[nested.body].pose;
      attached.push_back({nested.body, nested.carrier});
    }
    nested.fresh = false;
  }
  return attached;
}

void join_momentum(const physics::Body& body, const BodyMap& map, const Vec3d& velocity,
                   const Vec3d& spin, const mjModel& model, mjData& data) {
  const auto nv = static_cast<std::size_t>(model.nv);
  std::vector<double> move(3 * nv);
  std::vector<double> turn(3 * nv);
  const Pose engine{read_vector(data.xpos + 3 * map.id), read_quaternion(data.xquat + 4 * map.id)};
  const Pose pose = engine * inverse(map.engine_frame);
  const Vec3d center = transform_point(pose, body.center_of_mass);
  mj_jac(&model, &data, move.data(), turn.data(), center.v.data(), map.id);
  Vec3d excess = velocity;
  Vec3d excess_spin = spin;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < nv; ++k) {
      excess[i] -= move[i * nv + k] * data.qvel[k];
      excess_spin[i] -= turn[i * nv + k] * data.qvel[k];
    }
  }
  const Vec3d impulse = excess * body.mass;
  const Mat3d inertia = rotate_inertia(pose.orientation, body.inertia);
  Vec3d twist;
  for (std::size_t i = 0; i < 3; ++i) {
    twist[i] = dot({{inertia[i][0], inertia[i][1], inertia[i][2]}}, excess_spin);
  }
  std::vector<double> generalized(nv);
  std::vector<double> change(nv);
  for (std::size_t k = 0; k < nv; ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      generalized[k] += move[i * nv + k] * impulse[i] + turn[i * nv + k] * twist[i];
    }
  }
  mj_solveM(&model, &data, change.data(), generalized.data(), 1);
  for (std::size_t k = 0; k < nv; ++k) {
    data.qvel[k] += change[k];
  }
}

}  // namespace tenon::engines::mujoco
