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

void report_spring_damping(const scene::PhysicsScene& scene, double time_step,
                           std::string_view engine, std::string_view rule,
                           Diagnostics& diagnostics) {
  struct Spring {
    const scene::Joint* joint = nullptr;
    const scene::Drive* drive = nullptr;
    double added = 0;
  };
  std::vector<Spring> springs;
  for (const scene::Joint& joint : scene.joints) {
    for (const scene::Drive& drive : joint.drives) {
      const double added = drive.stiffness * time_step;
      if (joint.enabled && drive.max_force > 0 && added > drive.damping) {
        springs.push_back({&joint, &drive, added});
      }
    }
  }
  const auto worst =
      std::max_element(springs.begin(), springs.end(),
                       [](const Spring& a, const Spring& b) { return a.added < b.added; });
  if (worst == springs.end()) {
    return;
  }
  const bool turns = is_angular(worst->drive->dof);
  char text[240];
  std::snprintf(text, sizeof text,
                "drives of %s pull to where a step of %.3g s ends, which damps this spring like "
                "%.3g more than the authored %.3g %s",
                std::string(engine).c_str(), time_step, worst->added, worst->drive->damping,
                worst->drive->acceleration ? "1/s"
                : turns                    ? "N m s/rad"
                                           : "N s/m");
  Message message = text;
  for (const Spring& spring : springs) {
    if (spring.joint != worst->joint) {
      message.about(spring.joint->path, RelatedRole::Joint);
    }
  }
  Diagnostic finding;
  finding.severity = Severity::Info;
  finding.rule = rule;
  finding.prim = worst->joint->path.str();
  finding.say(message);
  finding.fix = "author damping, or take a smaller time step";
  diagnostics.add(std::move(finding));
}

}  // namespace tenon::engines
