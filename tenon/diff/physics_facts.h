// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "tenon/diff/physics_difference.h"

/// The objects of a scene as lists of facts, in a fixed order. Internal to tenon/diff.
namespace tenon::diff {

using Facts = std::vector<Fact>;

Facts facts_of(const physics::Scene& scene);
Facts facts_of(const physics::Body& body);
Facts facts_of(const physics::Material& material);
Facts facts_of(const physics::PhysicsScene& scene, const physics::Collider& collider);
Facts facts_of(const physics::PhysicsScene& scene, const physics::Joint& joint);
Facts facts_of(const physics::PhysicsScene& scene, const physics::Articulation& articulation);
Facts facts_of(const physics::PhysicsScene& scene, const physics::Tendon& tendon);

/// Makes lists of facts.
class FactList {
 public:
  FactList& number(const char* name, const char* unit, double value);
  FactList& numbers(const char* name, const char* unit, std::vector<double> values);
  FactList& vector(const char* name, const char* unit, const Vec3d& value);
  FactList& rotation(const char* name, const Quatd& value);
  FactList& word(const char* name, std::string value);
  FactList& flag(const char* name, bool value) { return word(name, value ? "yes" : "no"); }
  Facts take() { return std::move(facts_); }

 private:
  Facts facts_;
};

// What is for MuJoCo alone, where it is authored.
void add_mujoco(FactList& facts, const std::vector<physics::MujocoSetting>& settings);
void add_mujoco(FactList& facts, const physics::MujocoContact& contact);
void add_mujoco(FactList& facts, const physics::MujocoSoftness& softness);

}  // namespace tenon::diff
