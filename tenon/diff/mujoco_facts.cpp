// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What an asset says to MuJoCo alone, in MuJoCo's words.
#include "tenon/diff/physics_facts.h"

namespace tenon::diff {
namespace {

using physics::PhysicsScene;
using physics::TendonStop;

void add_numbers(FactList& facts, const char* name, const std::vector<double>& numbers) {
  if (!numbers.empty()) {
    facts.numbers(name, "", numbers);
  }
}

std::string body_of(const PhysicsScene& scene, const TendonStop::Place& place) {
  return place.body ? scene.bodies[*place.body].path.str() : std::string("world");
}

void add_place(FactList& facts, const PhysicsScene& scene, const std::string& name,
               const TendonStop::Place& place) {
  facts.word((name + "body").c_str(), body_of(scene, place))
      .vector((name + "position").c_str(), "m", place.pose.position)
      .rotation((name + "orientation").c_str(), place.pose.orientation);
}

void add_stop(FactList& facts, const PhysicsScene& scene, const std::string& name,
              const TendonStop& stop) {
  static constexpr const char* kKinds[] = {"site", "sphere", "cylinder", "pulley"};
  facts.word((name + "kind").c_str(), kKinds[static_cast<int>(stop.kind)]);
  if (stop.kind == TendonStop::Kind::Pulley) {
    facts.number((name + "divisor").c_str(), "", stop.divisor);
    return;
  }
  add_place(facts, scene, name, stop.place);
  if (stop.kind != TendonStop::Kind::Site) {
    facts.number((name + "radius").c_str(), "m", stop.radius);
  }
  if (stop.side) {
    add_place(facts, scene, name + "side ", *stop.side);
  }
}

}  // namespace

void add_mujoco(FactList& facts, const std::vector<physics::MujocoSetting>& settings) {
  for (const physics::MujocoSetting& setting : settings) {
    const std::string name = "MuJoCo " + setting.name;
    setting.token.empty() ? facts.numbers(name.c_str(), "", setting.numbers)
                          : facts.word(name.c_str(), setting.token);
  }
}

void add_mujoco(FactList& facts, const physics::MujocoContact& contact) {
  const auto number = [&](const char* name, const auto& value) {
    if (value) {
      facts.number(name, "", static_cast<double>(*value));
    }
  };
  number("MuJoCo condim", contact.condim);
  number("MuJoCo priority", contact.priority);
  number("MuJoCo solmix", contact.solmix);
  add_numbers(facts, "MuJoCo solref", contact.solref);
  add_numbers(facts, "MuJoCo solimp", contact.solimp);
}

void add_mujoco(FactList& facts, const physics::MujocoSoftness& softness) {
  add_numbers(facts, "MuJoCo solref of the limit", softness.solref_limit);
  add_numbers(facts, "MuJoCo solimp of the limit", softness.solimp_limit);
  add_numbers(facts, "MuJoCo solref of friction", softness.solref_friction);
  add_numbers(facts, "MuJoCo solimp of friction", softness.solimp_friction);
}

Facts facts_of(const PhysicsScene& scene, const physics::Tendon& tendon) {
  FactList facts;
  for (std::size_t i = 0; i < tendon.joints.size(); ++i) {
    facts.number(("coefficient of " + scene.joints[tendon.joints[i]].path.str()).c_str(), "",
                 tendon.coefficients[i]);
  }
  for (std::size_t i = 0; i < tendon.stops.size(); ++i) {
    add_stop(facts, scene, "stop " + std::to_string(i + 1) + " ", tendon.stops[i]);
  }
  facts.number("stiffness", "", tendon.stiffness)
      .number("damping", "", tendon.damping)
      .number("friction", "", tendon.friction)
      .number("armature", "", tendon.armature)
      .numbers("spring length", "", {tendon.spring_length.begin(), tendon.spring_length.end()});
  if (tendon.range) {
    facts.numbers("range", "", {tendon.range->begin(), tendon.range->end()});
  }
  add_mujoco(facts, tendon.settings);
  return facts.take();
}

}  // namespace tenon::diff
