// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One finding for each kind of fault, about the worst of its kind: a robot whose joints all shake
// says so once. The others are related, so that programs find them.
#include "tenon/watches/report_faults.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "tenon/base/text/text_number.h"
#include "tenon/math/angle.h"

namespace tenon::watches {
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
  RunReport(const scene::PhysicsScene& scene, const RunFaults& faults, Diagnostics& diagnostics,
            const std::string& engine)
      : scene_(scene), faults_(faults), diagnostics_(diagnostics), engine_(engine) {}

  void passages(const std::vector<engines::Event>& events) {
    for (const engines::Event& event : events) {
      if (event.kind == engines::EventKind::PassedThrough) {
        Message message = "at " + shortest(event.time) + " s the body " + event.what;
        message.about(event.other, RelatedRole::Collider);
        add("sim.passed-through", event.prim, std::move(message),
            "give a smaller --dt, so that it moves by less than its own size in a step");
      }
    }
  }

  /// About the first; a limit that gives way takes most of the speed.
  void rebounds(const std::vector<engines::Event>& events) {
    const engines::Event* first = nullptr;
    std::size_t count = 0;
    for (const engines::Event& event : events) {
      if (event.kind == engines::EventKind::ThrownBack) {
        first = first == nullptr ? &event : first;
        ++count;
      }
    }
    if (first == nullptr) {
      return;
    }
    Message message = "at " + shortest(first->time) + " s the joint " + first->what;
    for (const engines::Event& event : events) {
      if (event.kind == engines::EventKind::ThrownBack && event.prim != first->prim) {
        message.about(event.prim, RelatedRole::Joint);
      }
    }
    if (count > 1) {
      message += count == 2 ? ", and so was one more"
                            : ", and so were " + std::to_string(count - 1) + " more";
    }
    add("sim.limit-rebound", first->prim, std::move(message),
        "author mjc:solreflimit (0.0044, 8) and mjc:solimplimit (0.99, 0.999, 0.001, 0.5, 2) of "
        "MjcJointAPI: less than a tenth of it is left",
        Severity::Info);
  }

  void joints(JointFault::Kind kind) {
    const JointFault* worst = nullptr;
    for (const JointFault& fault : faults_.joints) {
      worst =
          fault.kind == kind && (worst == nullptr || fault.amount > worst->amount) ? &fault : worst;
    }
    if (worst == nullptr) {
      return;
    }
    const std::string size = in_words(*worst);
    switch (kind) {
      case JointFault::Kind::Shakes:
        add("sim.joint-shakes", *worst,
            "the joint shakes: its velocity changes sign within a few steps, at up to " + size +
                "/s",
            "take a smaller time step, or author a softer drive");
        break;
      case JointFault::Kind::BeyondLimit:
        add("sim.beyond-limit", *worst, "the joint stays " + size + " outside of its limits",
            "start within the limits, or look at what pushes the joint there");
        break;
      case JointFault::Kind::Sags:
        sags(*worst, size);
        break;
    }
  }

  void spins() {
    const auto worst =
        std::max_element(faults_.spins.begin(), faults_.spins.end(),
                         [](const auto& a, const auto& b) { return a.growth < b.growth; });
    if (worst == faults_.spins.end()) {
      return;
    }
    Message message = "the body turns at up to " + digits(worst->speed) +
                      " rad/s about an axis that changes, which is fast for the time step: its "
                      "wobble is off by about " +
                      digits(100 * worst->growth) + " %";
    for (const FastSpin& spin : faults_.spins) {
      if (spin.body != worst->body) {
        message.about(scene_.bodies[spin.body].path, RelatedRole::Body);
      }
    }
    say_how_many(faults_.spins.size(), message);
    add("sim.fast-spin", scene_.bodies[worst->body].path, std::move(message), finer_steps(),
        worst->growth > kMuchGrowth ? Severity::Warning : Severity::Info);
  }

  void drift() {
    if (!faults_.drift) {
      return;
    }
    const double change = faults_.drift->change;
    add("sim.energy-drift", Path(),
        "nothing takes or gives energy here, and " + digits(std::fabs(change)) + " J were " +
            (change < 0 ? "lost" : "gained") + ", " +
            digits(100 * std::fabs(change) / faults_.drift->moved) +
            " % of the largest kinetic energy",
        finer_steps(),
        std::fabs(change) > kMuchDrift * faults_.drift->moved ? Severity::Warning : Severity::Info);
  }

 private:
  static std::string in_words(const JointFault& fault) {
    return fault.angular ? digits(fault.amount * kDegreesPerRadian) + " degrees"
                         : digits(fault.amount) + " m";
  }

  void sags(const JointFault& worst, const std::string& size) {
    const scene::Drive& drive = scene_.joints[worst.joint].drives.front();
    const char* unit = worst.angular ? " N m" : " N";
    const bool limited = !drive.acceleration && worst.load > drive.max_force;
    std::string message = "the drive ends " + size +
                          " from its target: the weight on the joint takes " + digits(worst.load) +
                          unit;
    std::string fix;
    if (limited) {
      message += ", but its maxForce is " + digits(drive.max_force) + unit;
      fix = "author a maxForce that is at least " + digits(1.1 * worst.load / drive.max_force) +
            " times as large, or less mass";
    } else {
      message += ", too much for its stiffness";
      fix = "a stiffness " + digits(worst.amount / joint_unit(worst.angular)) +
            " times as large keeps it within " + (worst.angular ? "a degree" : "a millimetre");
    }
    // A drive may be a spring that is meant to give way.
    add("sim.drive-sags", worst, std::move(message), fix.c_str(),
        limited ? Severity::Warning : Severity::Info);
  }

  /// About the worst of its kind; the others are related.
  void add(const char* rule, const JointFault& worst, Message message, const char* fix,
           Severity severity = Severity::Warning) {
    std::size_t count = 0;
    for (const JointFault& fault : faults_.joints) {
      count += fault.kind == worst.kind ? 1 : 0;
      if (fault.kind == worst.kind && &fault != &worst) {
        message.about(scene_.joints[fault.joint].path, RelatedRole::Joint);
      }
    }
    say_how_many(count, message);
    add(rule, scene_.joints[worst.joint].path, std::move(message), fix, severity);
  }

  /// Several engines are run by `compare`, which has no option for the integrator.
  const char* finer_steps() const {
    return engine_.empty() ? "give a smaller --dt, or --engine mujoco --integrator rk4"
                           : "give a smaller --dt to all engines";
  }

  static void say_how_many(std::size_t count, Message& message) {
    if (count == 2) {
      message += ", and so does one more";
    } else if (count > 2) {
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
  const RunFaults& faults_;
  Diagnostics& diagnostics_;
  const std::string& engine_;
};

}  // namespace

void report_faults(const scene::PhysicsScene& scene, const RunFaults& faults,
                   const std::vector<engines::Event>& events, Diagnostics& diagnostics,
                   const std::string& engine) {
  RunReport report(scene, faults, diagnostics, engine);
  report.passages(events);
  report.rebounds(events);
  report.joints(JointFault::Kind::Shakes);
  report.joints(JointFault::Kind::BeyondLimit);
  report.joints(JointFault::Kind::Sags);
  report.spins();
  report.drift();
}

}  // namespace tenon::watches
