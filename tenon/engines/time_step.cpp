// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/time_step.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "tenon/base/text/text_number.h"

namespace tenon::engines {
namespace {

constexpr double kDefaultTimeStep = 0.002;  // [s]
constexpr double kLargestTimeStep = 0.004;  // [s] an asset's own step is divided until it is below

}  // namespace

double choose_time_step(const scene::PhysicsScene& scene, const SimulationOptions& options,
                        std::string_view engine, std::string_view rule, Diagnostics& diagnostics) {
  if (options.time_step > 0) {
    return options.time_step;
  }
  if (scene.scenes.empty() || !scene.scenes.front().time_step.has_value() ||
      !(*scene.scenes.front().time_step > 0)) {
    return kDefaultTimeStep;
  }
  const double asked = *scene.scenes.front().time_step;
  const double parts = std::ceil(asked / kLargestTimeStep - 1e-9);
  if (parts > 1) {
    diagnostics.add({Severity::Info, std::string(rule),
                     "the scene asks for steps of " + std::to_string(asked) + " s; " +
                         std::string(engine) + " takes " + shortest(parts) + " steps for each",
                     scene.scenes.front().path.str(), "", ""});
  }
  return asked / std::max(parts, 1.0);
}

}  // namespace tenon::engines
