// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One finding for each kind of fault, about the worst of its kind: a robot whose joints all shake
// says so once. The others are related, so that programs find them.
#include "tenon/bake/report_run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "tenon/base/text/text_number.h"
#include "tenon/math/angle.h"

namespace tenon::bake {
namespace {

// Above these a motion is not what the asset means; below it is less exact than at its best.
constexpr double kMuchGrowth = 0.3;
constexpr double kMuchDrift = 0.04;

std::string digits(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", number);
  return text;
}

class RunReport {
 public:
  RunReport(const scene::PhysicsScene& scene, const Run& run, Diagnostics& diagnostics,
            const std::string& engine)
      : scene_(scene), run_(run), diagnostics_(diagnostics), engine_(engine) {}

  void passages() {
    for (const engines::Event& event : run_.events) {
      if (event.kind == engines::EventKind::PassedThrough) {
        Message message = "at " + shortest(event.time) + " s the body " + event.what;
        message.about(event.other, RelatedRole::Collider);
        add("sim.passed-through", event.prim, std::move(message),
            "give a smaller --dt, so that it moves by less than its own size in a step");
      }
    }
  }

  void joints(JointFault::Kind kind) {
    const JointFault* worst = nullptr;
    std::size_t count = 0;
    for (const JointFault& fault : run_.joint_faults) {
      count += fault.kind == kind ? 1 : 0;
      worst =
          fault.kind == kind && (worst == nullptr || fault.amount > worst->amount) ? &fault : worst;
    }
    if (worst == nullptr) {
      return;
    }
    const bool shakes = kind == JointFault::Kind::Shakes;
    const double amount = worst->angular ? worst->amount * kDegreesPerRadian : worst->amount;
    const std::string size = digits(amount) + (worst->angular ? " degrees" : " m");
    Message message =
        shakes ? "the joint shakes: its velocity changes sign within a few steps, at up to " +
                     (size + "/s")
               : "the joint ends the run " + size + " outside of its limits";
    for (const JointFault& fault : run_.joint_faults) {
      if (fault.kind == kind && &fault != worst) {
        message.about(scene_.joints[fault.joint].path, RelatedRole::Joint);
      }
    }
    say_how_many(count, message);
    add(shakes ? "sim.joint-shakes" : "sim.beyond-limit", scene_.joints[worst->joint].path,
        std::move(message),
        shakes ? "take a smaller time step, or author a softer drive"
               : "start within the limits, or look at what pushes the joint there");
  }

  void spins() {
    const auto worst =
        std::max_element(run_.fast_spins.begin(), run_.fast_spins.end(),
                         [](const auto& a, const auto& b) { return a.growth < b.growth; });
    if (worst == run_.fast_spins.end()) {
      return;
    }
    Message message = "the body turns at up to " + digits(worst->speed) +
                      " rad/s about an axis that changes, which is fast for the time step: its "
                      "wobble is off by about " +
                      digits(100 * worst->growth) + " %";
    for (const FastSpin& spin : run_.fast_spins) {
      if (spin.body != worst->body) {
        message.about(scene_.bodies[spin.body].path, RelatedRole::Body);
      }
    }
    say_how_many(run_.fast_spins.size(), message);
    add("sim.fast-spin", scene_.bodies[worst->body].path, std::move(message), finer_steps(),
        worst->growth > kMuchGrowth ? Severity::Warning : Severity::Info);
  }

  void drift() {
    if (!run_.drift) {
      return;
    }
    const double change = run_.drift->change;
    add("sim.energy-drift", {},
        "nothing takes or gives energy here, and " + digits(std::fabs(change)) + " J were " +
            (change < 0 ? "lost" : "gained") + ", " +
            digits(100 * std::fabs(change) / run_.drift->moved) +
            " % of the largest kinetic energy",
        finer_steps(),
        std::fabs(change) > kMuchDrift * run_.drift->moved ? Severity::Warning : Severity::Info);
  }

 private:
  /// Several engines are run by `compare`, which has no option for the integrator.
  const char* finer_steps() const {
    return engine_.empty() ? "give a smaller --dt, or --engine mujoco --integrator rk4"
                           : "give a smaller --dt to all engines";
  }

  static void say_how_many(std::size_t count, Message& message) {
    if (count > 1) {
      message += ", and so do " + std::to_string(count - 1) + " more";
    }
  }

  void add(const char* rule, const Path& prim, Message message, const char* fix,
           Severity severity = Severity::Warning) {
    Diagnostic finding;
    finding.severity = severity;
    finding.rule = rule;
    finding.prim = prim.str();
    if (!engine_.empty()) {
      message += " (on " + engine_ + ")";
    }
    finding.say(message);
    finding.fix = fix;
    diagnostics_.add(std::move(finding));
  }

  const scene::PhysicsScene& scene_;
  const Run& run_;
  Diagnostics& diagnostics_;
  const std::string& engine_;
};

}  // namespace

void report_run(const scene::PhysicsScene& scene, const Run& run, Diagnostics& diagnostics,
                const std::string& engine) {
  RunReport report(scene, run, diagnostics, engine);
  report.passages();
  report.joints(JointFault::Kind::Shakes);
  report.joints(JointFault::Kind::BeyondLimit);
  report.spins();
  report.drift();
}

}  // namespace tenon::bake
