// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Absurd gains are judged as the file has them, opinion by opinion, in the file's unit. All else is
// judged on the drives of the scene in SI, where limits and mimics are known too, and messages turn
// the numbers back into units of the asset. A drive without stiffness and damping exerts no force,
// so most rules skip it.
#include <algorithm>
#include <cmath>

#include "tenon/check/joint_state.h"
#include "tenon/check/subject.h"

namespace tenon::check {
namespace {

using scene::Drive;
using scene::Joint;
using scene::JointKind;

constexpr double kAbsurdGain = 1e9;    ///< in the file's own unit
constexpr double kTargetSlack = 1e-3;  ///< [rad or m] beyond a limit

const Token kDriveApi("PhysicsDriveAPI");

std::string attribute_name(Token instance, const char* what) {
  return "drive:" + instance.str() + ":physics:" + what;
}

/// Calls visit(prim, name, value) for each authored number of each drive.
template <class Visit>
void each_gain(const Subject& subject, Visit visit) {
  for (const stage::Prim& prim : subject.prims) {
    for (const Token instance : prim.api_instances(kDriveApi)) {
      for (const char* what : {"stiffness", "damping"}) {
        const std::string name = attribute_name(instance, what);
        if (const std::optional<double> value = authored_number(prim, name)) {
          visit(prim, name, *value);
        }
      }
    }
  }
}

template <class Visit>
void each_drive(const Subject& subject, Visit visit) {
  for (const Joint& joint : subject.scene.joints) {
    for (const Drive& drive : joint.drives) {
      visit(joint, drive, subject.stage.prim(drive.source));
    }
  }
}

/// The reader has said why the joint has neither drive nor mimic: it asks for one in vain.
bool is_told_why(const Subject& subject, Path joint) {
  const std::string path = joint.str();
  for (const char* rule : {"mimic.leader-missing", "mimic.cycle", "drive.no-such-axis"}) {
    if (subject.has_finding(rule, path)) {
      return true;
    }
  }
  const std::vector<Token> names = subject.stage.prim(joint).authored_property_names();
  return std::any_of(names.begin(), names.end(), [&](Token name) {
    return name.view().starts_with("drive:") && subject.is_reported(path, name.str());
  });
}

bool acts(const Drive& drive) { return drive.stiffness != 0 || drive.damping != 0; }

}  // namespace

void check_absurd_gain(const Subject& subject, Reporter& report) {
  each_gain(subject, [&](const stage::Prim& prim, const std::string& name, double value) {
    if (value > kAbsurdGain && std::isfinite(value)) {
      report.at(prim, name, name + " is " + digits(value) + ", more than solvers can follow",
                "author a gain that fits the masses and the time step, or lock the axis");
    }
  });
}

void check_max_force_zero(const Subject& subject, Reporter& report) {
  each_drive(subject, [&](const Joint&, const Drive& drive, const stage::Prim& prim) {
    if (drive.max_force == 0 && acts(drive)) {
      report.at(prim, "the drive has gains but a maxForce of 0: no force",
                "author a positive maxForce, or leave it out");
    }
  });
}

void check_max_force_unlimited(const Subject& subject, Reporter& report) {
  each_drive(subject, [&](const Joint& joint, const Drive& drive, const stage::Prim& prim) {
    if (joint.articulation && std::isinf(drive.max_force) && acts(drive)) {
      report.at(prim, "the drive has no force limit: it is stronger than any real actuator",
                "author maxForce as the actuator's limit");
    }
  });
}

// S-101
void check_target_limits(const Subject& subject, Reporter& report) {
  each_drive(subject, [&](const Joint& joint, const Drive& drive, const stage::Prim& prim) {
    if (!has_one_axis(joint) || drive.stiffness == 0 || joint.lower > joint.upper) {
      return;
    }
    const double target = drive.target_position;
    if (target < joint.lower - kTargetSlack || target > joint.upper + kTargetSlack) {
      const double unit = coordinate_unit(subject.scene, joint);
      report.at(prim,
                "the drive's target " + digits(target * unit) + " is outside of the limits " +
                    digits(joint.lower * unit) + " and " + digits(joint.upper * unit),
                "author a target within the limits");
    }
  });
}

void check_target_state(const Subject& subject, Reporter& report) {
  each_drive(subject, [&](const Joint& joint, const Drive& drive, const stage::Prim& prim) {
    if (!has_one_axis(joint) || drive.stiffness == 0 || !joint.initial_position) {
      return;
    }
    if (std::fabs(drive.target_position - *joint.initial_position) > 1e-2) {
      const double unit = coordinate_unit(subject.scene, joint);
      report.at(prim,
                "the drive's target " + digits(drive.target_position * unit) +
                    " differs from the joint state " + digits(*joint.initial_position * unit) +
                    ": the joint jerks at the start",
                "author the state as the target, or accept the motion");
    }
  });
}

// A robot of which some joints are driven and others hang loose.
void check_drive_missing(const Subject& subject, Reporter& report) {
  for (const scene::Articulation& articulation : subject.scene.articulations) {
    const auto is_driven = [&](scene::Index i) {
      const Joint& joint = subject.scene.joints[i];
      return std::any_of(joint.drives.begin(), joint.drives.end(), acts);
    };
    const bool some =
        std::any_of(articulation.joints.begin(), articulation.joints.end(), is_driven);
    for (const scene::Index i : articulation.joints) {
      const Joint& joint = subject.scene.joints[i];
      const bool loose = has_one_axis(joint) && joint.drives.empty() && joint.mimics.empty() &&
                         joint.stiffness == 0 && joint.lower < joint.upper;
      const Path path = joint.path;
      if (some && loose && !is_told_why(subject, path)) {
        report.at(subject.stage.prim(joint.path),
                  "the joint has neither drive nor mimic, other joints of the robot have",
                  "apply PhysicsDriveAPI, or a fixed joint if it is not to move");
      }
    }
  }
}

// Isaac: a follower is driven by its leader alone.
void check_drive_on_mimic(const Subject& subject, Reporter& report) {
  each_drive(subject, [&](const Joint& joint, const Drive& drive, const stage::Prim& prim) {
    const bool follows = std::any_of(joint.mimics.begin(), joint.mimics.end(),
                                     [&](const auto& mimic) { return mimic.dof == drive.dof; });
    if (follows && acts(drive)) {
      report.at(prim, "the joint follows another one and has a drive of its own: they fight",
                "set the drive's stiffness and damping to 0");
    }
  });
}

}  // namespace tenon::check
