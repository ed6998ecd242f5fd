// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A variation is drawn once per environment and acts on all objects that it names, so that what an
// environment is can be told by one number each. Draws are a mix of seed, environment and number of
// the variation and know no order, so that environment 7 is the same among 8 and among 800.
#include "tenon/asset/many_environments/variation.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include "tenon/base/text/text_number.h"
#include "tenon/scene/fields/scale_field.h"

namespace tenon {
namespace {

using engines::Parameter;
using scene::Index;

constexpr std::size_t kParameterCount = static_cast<std::size_t>(Parameter::JointArmature) + 1;

Error bad_variation(const std::string& text, const std::string& why) {
  std::string names = "gravity, jointPosition, bodyPosition";
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    names += ", " + std::string(engines::parameter_name(static_cast<Parameter>(i)));
  }
  return Error(ErrorCode::Invalid, "\"" + text + "\" " + why)
      .with_rule("usage.value")
      .with_fix("write NAME=LOW..HIGH or NAME@/path=LOW..HIGH, where NAME is " + names +
                ", or a field such as colliders.shape.radius");
}

std::optional<Parameter> parameter_named(std::string_view name) {
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    if (engines::parameter_name(static_cast<Parameter>(i)) == name) {
      return static_cast<Parameter>(i);
    }
  }
  return std::nullopt;
}

Result<void> read_range(const std::string& text, const std::string& range, Variation& variation) {
  const std::size_t dots = range.find("..");
  const std::string low = range.substr(0, dots);
  const std::string high = dots == std::string::npos ? low : range.substr(dots + 2);
  const auto first = parse_double(low);
  const auto last = parse_double(high);
  if (!first || !last || !(*first <= *last) || !(*last - *first < scene::kUnlimited)) {
    return bad_variation(text, "has no range of numbers");
  }
  variation.low = *first;
  variation.high = *last;
  return {};
}

std::uint64_t mixed(std::uint64_t number) {
  number += 0x9e3779b97f4a7c15U;
  number = (number ^ (number >> 30U)) * 0xbf58476d1ce4e5b9U;
  number = (number ^ (number >> 27U)) * 0x94d049bb133111ebU;
  return number ^ (number >> 31U);
}

// ---- parameters

bool is_meant(const Variation& variation, const Path& object) {
  return scene::is_meant(variation.object, object);
}

struct ParameterValue {
  engines::ParameterKey key;
  double now = 0;
};

void add_body_values(const Variation& variation, const scene::PhysicsScene& scene,
                     std::vector<ParameterValue>& values) {
  for (Index i = 0; i < scene.bodies.size(); ++i) {
    const bool skipped = variation.object.empty() && scene.bodies[i].kinematic;
    if (!skipped && is_meant(variation, scene.bodies[i].path)) {
      values.push_back({{Parameter::BodyMass, i}, scene.bodies[i].mass});
    }
  }
}

void add_friction_values(const Variation& variation, const scene::PhysicsScene& scene,
                         std::vector<ParameterValue>& values) {
  for (Index i = 0; i < scene.colliders.size(); ++i) {
    const scene::Collider& collider = scene.colliders[i];
    if (is_meant(variation, collider.path)) {
      const scene::Material& material =
          collider.material ? scene.materials[*collider.material] : scene.unbound;
      values.push_back({{Parameter::ColliderFriction, i}, material.dynamic_friction});
    }
  }
}

double drive_value(const scene::Drive& drive, Parameter parameter) {
  return parameter == Parameter::DriveStiffness ? drive.stiffness
         : parameter == Parameter::DriveDamping ? drive.damping
                                                : drive.max_force;
}

double joint_value(const scene::Joint& joint, Parameter parameter) {
  return parameter == Parameter::JointDamping    ? joint.damping
         : parameter == Parameter::JointFriction ? joint.friction
                                                 : joint.armature;
}

bool is_of_drives(Parameter parameter) {
  return parameter == Parameter::DriveStiffness || parameter == Parameter::DriveDamping ||
         parameter == Parameter::DriveMaxForce;
}

/// Values that are zero or unlimited stay so whatever the factor is, and are skipped.
void add_joint_values(const Variation& variation, const scene::PhysicsScene& scene,
                      std::vector<ParameterValue>& values) {
  const auto add = [&](const engines::ParameterKey& key, double now) {
    if (now != 0 && now < scene::kUnlimited) {
      values.push_back({key, now});
    }
  };
  for (Index j = 0; j < scene.joints.size(); ++j) {
    const scene::Joint& joint = scene.joints[j];
    if (!is_meant(variation, joint.path)) {
      continue;
    }
    if (!is_of_drives(variation.parameter)) {
      add({variation.parameter, j}, joint_value(joint, variation.parameter));
      continue;
    }
    for (Index d = 0; d < joint.drives.size(); ++d) {
      add({variation.parameter, j, d}, drive_value(joint.drives[d], variation.parameter));
    }
  }
}

std::vector<ParameterValue> values_of(const Variation& variation,
                                      const scene::PhysicsScene& scene) {
  std::vector<ParameterValue> values;
  if (variation.parameter == Parameter::BodyMass) {
    add_body_values(variation, scene, values);
  } else if (variation.parameter == Parameter::ColliderFriction) {
    add_friction_values(variation, scene, values);
  } else {
    add_joint_values(variation, scene, values);
  }
  return values;
}

Error no_object(const Variation& variation) {
  const std::string where =
      variation.object.empty() ? "of the asset" : "at <" + variation.object.str() + ">";
  return Error(ErrorCode::NotFound, "nothing " + where + " has what " + variation.text + " varies")
      .with_rule("vary.no-object")
      .with_fix("tenon physics --json lists what there is");
}

Result<void> vary_parameter(const Variation& variation, double factor,
                            const scene::PhysicsScene& scene, engines::World& world) {
  const std::vector<ParameterValue> values = values_of(variation, scene);
  for (const ParameterValue& value : values) {
    TENON_CHECK(world.set_parameter(value.key, value.now * factor));
  }
  return values.empty() ? Result<void>(no_object(variation)) : Result<void>();
}

Result<void> vary_gravity(double factor, const scene::PhysicsScene& scene, engines::World& world) {
  for (Index i = 0; i < scene.scenes.size(); ++i) {
    TENON_CHECK(world.set_gravity(i, scene.scenes[i].gravity * factor));
  }
  return {};
}

Result<void> vary_joints(const Variation& variation, double offset,
                         const scene::PhysicsScene& scene, engines::World& world) {
  bool any = false;
  for (Index j = 0; j < scene.joints.size(); ++j) {
    engines::JointState state = world.joint_state(j);
    if (!is_meant(variation, scene.joints[j].path) || state.position.empty()) {
      continue;
    }
    for (double& position : state.position) {
      position += offset;
    }
    TENON_CHECK(world.set_joint_state(j, state));
    any = true;
  }
  return any ? Result<void>() : Result<void>(no_object(variation));
}

/// Bodies that joints carry are skipped, unless one is named.
Result<void> vary_bodies(const Variation& variation, const std::vector<double>& offset,
                         const scene::PhysicsScene& scene, engines::World& world) {
  bool any = false;
  for (Index i = 0; i < scene.bodies.size(); ++i) {
    const bool named = !variation.object.empty();
    if (scene.bodies[i].kinematic || !is_meant(variation, scene.bodies[i].path)) {
      continue;
    }
    engines::BodyState state = world.body_state(i);
    state.pose.position = state.pose.position + Vec3d{{offset[0], offset[1], offset[2]}};
    Result<void> moved = world.set_body_state(i, state);
    if (!moved && named) {
      return moved;
    }
    any = any || moved;
  }
  return any ? Result<void>() : Result<void>(no_object(variation));
}

}  // namespace

Result<Variation> read_variation(const std::string& text) {
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos) {
    return bad_variation(text, "is not a variation");
  }
  Variation variation;
  variation.text = text.substr(0, equals);
  TENON_CHECK(read_range(text, text.substr(equals + 1), variation));
  const std::size_t at = variation.text.find('@');
  const std::string name = variation.text.substr(0, at);
  if (at != std::string::npos) {
    variation.object = Path::from(variation.text.substr(at + 1));
    if (variation.object.empty()) {
      return bad_variation(text, "names no path behind the @");
    }
  }
  const std::size_t dot = name.find('.');
  if (const auto parameter = parameter_named(name)) {
    variation.place = VariationPlace::Parameter;
    variation.parameter = *parameter;
  } else if (name == "gravity") {
    variation.place = VariationPlace::Gravity;
  } else if (name == "jointPosition") {
    variation.place = VariationPlace::JointPositions;
  } else if (name == "bodyPosition") {
    variation.place = VariationPlace::BodyPositions;
  } else if (dot != std::string::npos) {
    variation.list = name.substr(0, dot);
    variation.field = name.substr(dot + 1);
  } else {
    return bad_variation(text, "is not a variation");
  }
  return variation;
}

double draw(std::uint64_t seed, std::size_t environment, std::size_t variation, std::size_t part,
            double low, double high) {
  const std::uint64_t bits =
      mixed(mixed(mixed(mixed(seed) + environment) + variation) + part) >> 11U;
  return low + (high - low) * (static_cast<double>(bits) / 9007199254740992.0);
}

std::vector<double> drawn(const Variation& variation, std::uint64_t seed, std::size_t environment,
                          std::size_t number) {
  std::vector<double> numbers(variation.place == VariationPlace::BodyPositions ? 3 : 1);
  for (std::size_t part = 0; part < numbers.size(); ++part) {
    numbers[part] = draw(seed, environment, number, part, variation.low, variation.high);
  }
  return numbers;
}

Result<void> vary_world(const Variation& variation, const std::vector<double>& numbers,
                        const scene::PhysicsScene& scene, engines::World& world) {
  switch (variation.place) {
    case VariationPlace::Parameter:
      return vary_parameter(variation, numbers.front(), scene, world);
    case VariationPlace::Gravity:
      return vary_gravity(numbers.front(), scene, world);
    case VariationPlace::JointPositions:
      return vary_joints(variation, numbers.front(), scene, world);
    case VariationPlace::BodyPositions:
      return vary_bodies(variation, numbers, scene, world);
    case VariationPlace::Field:
      break;
  }
  return {};
}

Result<void> vary_scene(const Variation& variation, double factor, scene::PhysicsScene& scene) {
  const std::size_t count =
      scene::scale_field(variation.list, variation.field, variation.object, factor, scene);
  return count > 0 ? Result<void>() : Result<void>(no_object(variation));
}

}  // namespace tenon
