// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The world that a model brings along. A robot is put into scenes that have gravity and a solver of
// their own, and a second PhysicsScene would be one more world: so none is written unless asked
// for, and the loss is reported.
#include "tenon/convert/physics_scene.h"

#include <cmath>

#include "tenon/convert/mujoco_values.h"

namespace tenon::convert {

using layer::Value;

namespace {

bool is_usual(const robot::MujocoScene& scene) {
  const robot::MujocoScene usual;
  return scene.gravity == usual.gravity && scene.time_step == usual.time_step &&
         scene.settings.empty();
}

std::string words_of(const robot::MujocoScene& scene) {
  const robot::MujocoScene usual;
  std::string words;
  const auto add = [&](const std::string& word) { words += (words.empty() ? "" : ", ") + word; };
  if (scene.gravity != usual.gravity) {
    add("gravity");
  }
  if (scene.time_step != usual.time_step) {
    add("timestep");
  }
  for (const robot::MujocoSetting& setting : scene.settings) {
    add(setting.name.substr(setting.name.find(':') + 1));
  }
  return words;
}

}  // namespace

void write_scene(const Source& source, PhysicsScope& physics) {
  if (!source.model.mujoco.scene) {
    if (source.options.scene) {
      physics.layer().report({}, Severity::Info, "convert.without-effect",
                             "--scene has no effect: the description has no world", "leave it out");
    }
    return;
  }
  const robot::MujocoScene& scene = *source.model.mujoco.scene;
  if (!source.options.scene) {
    if (!is_usual(scene)) {
      physics.layer().report(
          {}, Severity::Warning, "convert.scene",
          "the model's world is skipped, since robots get that of the scene they are put into: " +
              words_of(scene),
          "--scene keeps it as a PhysicsScene");
    }
    return;
  }
  LayerBuilder& builder = physics.builder();
  const Path path = physics.define("PhysicsScene", "PhysicsScene");
  const Vec3d gravity{{scene.gravity[0], scene.gravity[1], scene.gravity[2]}};
  const double magnitude = length(gravity);
  const Vec3d down{{0, 0, -1}};
  builder.set_vector(path, "PhysicsScene", "physics:gravityDirection",
                     magnitude > 0 ? gravity * (1 / magnitude) : down);
  builder.set_number(path, "PhysicsScene", "physics:gravityMagnitude", magnitude);
  builder.apply(path, "NewtonSceneAPI");
  const double rate = scene.time_step > 0 ? 1 / scene.time_step : 0;
  if (rate >= 1 && rate < 1e9 && 1 / std::round(rate) == scene.time_step) {
    builder.set_number(path, "NewtonSceneAPI", "newton:timeStepsPerSecond", std::round(rate));
  }
  builder.apply(path, "MjcSceneAPI");
  builder.set_number(path, "MjcSceneAPI", "mjc:option:timestep", scene.time_step);
  write_settings(builder, path, "MjcSceneAPI", scene.settings);
}

}  // namespace tenon::convert
