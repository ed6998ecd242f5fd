// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenes are listed by path. The default scene is the first in the order of the stage (S-18), which
// may be another one. When there is no scene, one with the gravity of earth is made up, so that
// every body has a scene. Gravity is in world axes; a direction of zero means down (S-14, S-17).
// Time steps come from vendors' attributes, the strongest first, and a step so short that a run
// would not end is refused.
#include "tenon/physics/scenes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tenon/base/limits/work_limits.h"
#include "tenon/base/text/text_number.h"
#include "tenon/physics/read_state.h"
#include "tenon/physics/vendors/mujoco_settings.h"
#include "tenon/physics/vendors/physx_settings.h"

namespace tenon::physics {
namespace {

constexpr double kEarthGravity = 9.81;  ///< [m/s^2] (S-16)

/// Magnitude in m/s^2: any negative value means earth (S-15).
double gravity_magnitude(const ReadState& state, const stage::Prim& prim) {
  const std::optional<double> authored = state.values.number(prim, state.tokens.gravity_magnitude);
  const bool literal = state.readings.negative_gravity == NegativeGravity::Literal;
  if (!authored || std::isinf(*authored) || (*authored < 0 && !literal)) {
    if (authored && std::isfinite(*authored)) {
      state.report(prim, state.tokens.gravity_magnitude, Severity::Warning,
                   "scene.negative-gravity",
                   "physics:gravityMagnitude is " + text_of_float(*authored) +
                       "; a negative magnitude means earth gravity",
                   "turn physics:gravityDirection instead, or leave the magnitude out");
    }
    return kEarthGravity;
  }
  return *authored * state.units.length * state.units.rate * state.units.rate;
}

/// A name from before the schema was published.
void report_legacy_gravity(const ReadState& state, const stage::Prim& prim) {
  const Token name("gravity");
  if (prim.has_property(name)) {
    state.report(prim, name, Severity::Warning, "scene.legacy-gravity",
                 "the attribute gravity is ignored",
                 "author physics:gravityDirection and physics:gravityMagnitude");
  }
}

Vec3d read_gravity(const ReadState& state, const stage::Prim& prim, const Roles& roles) {
  // S-14, S-17: world axes; zero means down.
  const Vec3d authored =
      state.values.vector(prim, state.tokens.gravity_direction).value_or(Vec3d{});
  const Vec3d direction = normalized(authored, -state.units.up);
  double magnitude = gravity_magnitude(state, prim);
  if ((roles.has(Api::NewtonScene) || roles.has(Api::MjcScene)) &&
      !state.values.authored_flag(prim, state.tokens.newton_gravity_enabled).value_or(true)) {
    magnitude = 0;
  }
  return direction * magnitude;
}

}  // namespace

Vec3d scene_gravity(const ReadState& state, const PhysicsPrim& found) {
  return read_gravity(state, found.prim, found.roles);
}

namespace {

/// Nothing, and a warning, where a run would never end.
std::optional<double> usable_step(const ReadState& state, const stage::Prim& prim, double step) {
  if (step * static_cast<double>(limits::kStepsPerSecond) >= 1) {
    return step;
  }
  state.report(prim, Severity::Warning, "scene.time-step",
               "the scene asks for steps of " + shortest(step) + " s, " +
                   (step > 0 ? "more than " + std::to_string(limits::kStepsPerSecond) +
                                   " in a second (kStepsPerSecond)"
                             : std::string("which lead nowhere")) +
                   "; the engine's own step is used",
               "author a longer step");
  return std::nullopt;
}

/// The step that the strongest of the vendors' APIs asks for: Newton, PhysX, MuJoCo.
std::optional<double> read_time_step(const ReadState& state, const stage::Prim& prim,
                                     const Roles& roles) {
  const AttributeValues& values = state.values;
  std::optional<double> rate;
  if (roles.has(Api::NewtonScene) || roles.has(Api::MjcScene)) {
    rate = values.authored_number(prim, state.tokens.newton_steps);
  }
  if (!rate && roles.has(Api::PhysxScene)) {
    rate = values.authored_number(prim, state.tokens.physx_steps);
  }
  if (rate && *rate > 0 && std::isfinite(*rate)) {
    return usable_step(state, prim, 1 / *rate);
  }
  if (roles.has(Api::MjcScene)) {
    const std::optional<double> step = values.authored_number(prim, state.tokens.mjc_time_step);
    if (step && std::isfinite(*step)) {
      return usable_step(state, prim, *step);
    }
  }
  return std::nullopt;
}

/// Options and flags of MuJoCo's solver, in the order of their names.
std::optional<std::vector<VendorSetting>> read_mujoco(const stage::Prim& prim, const Roles& roles) {
  if (!roles.has(Api::MjcScene)) {
    return std::nullopt;
  }
  std::vector<VendorSetting> settings;
  for (const Token& name : prim.authored_property_names()) {
    const std::string_view text = name.view();
    if (!text.starts_with("mjc:option:") && !text.starts_with("mjc:flag:")) {
      continue;
    }
    if (auto setting = read_mujoco_setting(prim, name); setting && text != "mjc:option:timestep") {
      settings.push_back(*std::move(setting));
    }
  }
  std::sort(settings.begin(), settings.end(),
            [](const VendorSetting& a, const VendorSetting& b) { return a.name < b.name; });
  return settings;
}

/// A stage with physics but without a scene gets one with earth's gravity (S-18).
void add_implicit_scene(ReadState& state) {
  Scene made_up;
  made_up.gravity = -state.units.up * kEarthGravity;
  state.scene.scenes.push_back(made_up);
  for (const PhysicsPrim& found : state.walk.prims) {
    if (found.is_body) {
      state.report(found.prim, Severity::Info, "scene.missing",
                   "there are bodies but no PhysicsScene; earth gravity is assumed",
                   "add a PhysicsScene prim where the asset is not part of another scene");
      return;
    }
  }
}

}  // namespace

void read_scenes(ReadState& state) {
  const auto prims = sorted_prims(
      state.walk, [](const PhysicsPrim& p) { return p.roles.kind == PrimKind::Scene; });
  for (const std::uint32_t i : prims) {
    const PhysicsPrim& found = state.walk.prims[i];
    report_legacy_gravity(state, found.prim);
    Scene scene;
    scene.path = found.path;
    scene.gravity = read_gravity(state, found.prim, found.roles);
    scene.time_step = read_time_step(state, found.prim, found.roles);
    scene.parts.mujoco = read_mujoco(found.prim, found.roles);
    if (found.roles.has(Api::PhysxScene)) {
      scene.parts.physx = read_physx_settings(found.prim, "physxScene:", state.units);
    }
    state.scene.scenes.push_back(std::move(scene));
  }
  if (prims.empty()) {
    add_implicit_scene(state);
  }
}

std::optional<Index> scene_at(const ReadState& state, Path path) {
  for (Index i = 0; i < state.scene.scenes.size(); ++i) {
    if (state.scene.scenes[i].path == path) {
      return i;
    }
  }
  return std::nullopt;
}

Index default_scene(const ReadState& state) {
  if (state.scene.scenes.size() > 1) {
    for (const PhysicsPrim& found : state.walk.prims) {
      if (found.roles.kind == PrimKind::Scene) {
        return scene_at(state, found.path).value_or(0);
      }
    }
  }
  return 0;
}

OwnerScene owner_scene(const ReadState& state, const stage::Prim& prim, Index fallback) {
  const std::vector<Path> targets = state.targets(prim, state.tokens.simulation_owner);
  if (targets.empty()) {
    return {fallback, true};
  }
  if (targets.size() > 1) {
    state.values.report_target(prim, state.tokens.simulation_owner, targets[1], Severity::Error,
                               "scene.several-owners",
                               "physics:simulationOwner has " + std::to_string(targets.size()) +
                                   " targets; only the first counts",
                               "leave one target");
  }
  const std::optional<Index> scene = scene_at(state, targets.front());
  if (!scene) {
    state.values.report_target(prim, state.tokens.simulation_owner, targets.front(),
                               Severity::Error, "scene.owner-missing",
                               "physics:simulationOwner names " +
                                   named(targets.front(), RelatedRole::Target) +
                                   ", which is not a PhysicsScene; it is not simulated",
                               "name a PhysicsScene, or none");
    return {fallback, false};
  }
  return {*scene, true};
}

}  // namespace tenon::physics
