// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers that would be right in another unit: the gravity of the earth in metres where the stage
// counts in centimetres, fractions of pi where degrees are meant. A number is suspect only where it
// is round in the other unit and not in its own; a length where no mechanism is that large beside
// its parts.
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "tenon/check/extents.h"
#include "tenon/check/joint_state.h"
#include "tenon/check/subject.h"

namespace tenon::check {
namespace {

constexpr double kEarth = 9.81;         ///< [m/s^2]
constexpr double kNearEarth = 5e-3;     ///< relative; 9.8 and 9.80665 are earth, too
constexpr double kNearFraction = 1e-3;  ///< relative; 3.14 and 1.57 are typed for pi and pi/2
constexpr double kFarAnchor = 50;       ///< half diagonals of a body from its middle
constexpr double kNearAnchor = 1;       ///< [m]; less is near whatever the body's size
constexpr double kFarTravel = 300;      ///< half diagonals of the larger body
constexpr std::array kLengthUnits{1.0, 0.01, 0.001};

/// The unit of length in which `gravity` is that of the earth.
std::optional<double> unit_of_earth(double gravity) {
  for (const double unit : kLengthUnits) {
    if (std::fabs(gravity * unit / kEarth - 1) < kNearEarth) {
      return unit;
    }
  }
  return std::nullopt;
}

/// "pi/2", of a number that is one of the fractions that people type.
std::string fraction_of_pi(double value) {
  struct Fraction {
    double value;
    const char* text;
  };
  static constexpr std::array<Fraction, 10> kFractions{{{1.0 / 6, "pi/6"},
                                                        {1.0 / 4, "pi/4"},
                                                        {1.0 / 3, "pi/3"},
                                                        {1.0 / 2, "pi/2"},
                                                        {2.0 / 3, "2 pi/3"},
                                                        {3.0 / 4, "3 pi/4"},
                                                        {5.0 / 6, "5 pi/6"},
                                                        {1, "pi"},
                                                        {1.5, "3 pi/2"},
                                                        {2, "2 pi"}}};
  for (const Fraction& fraction : kFractions) {
    const double exact = fraction.value * kPi;
    if (std::fabs(std::fabs(value) - exact) < kNearFraction * exact) {
      return (value < 0 ? "-" : "") + std::string(fraction.text);
    }
  }
  return {};
}

bool is_angular_instance(Token instance) {
  return instance == "angular" || instance.view().starts_with("rot");
}

/// The joint starts where its drive wants it: the number is meant as it is.
bool starts_there(const Subject& subject, const stage::Prim& prim, double target_deg) {
  const auto joint = subject.joint_at(prim.path());
  return joint && has_one_axis(subject.scene.joints[*joint]) &&
         std::fabs(start_coordinate(subject.scene, subject.scene.joints[*joint]) *
                       kDegreesPerRadian -
                   target_deg) < 1e-2;
}

}  // namespace

// S-16
void check_gravity_unit(const Subject& subject, Reporter& report) {
  const Token name("physics:gravityMagnitude");
  const double own = subject.scene.meters_per_unit;
  for (const stage::Prim& prim : subject.prims) {
    const std::optional<double> value =
        prim.type_name() == "PhysicsScene" ? authored_number(prim, name) : std::nullopt;
    const std::optional<double> unit = value ? unit_of_earth(*value) : std::nullopt;
    if (unit && std::fabs(own / *unit - 1) > 1e-3) {
      report.at(prim, name,
                "a gravity of " + digits(*value) + " is that of the earth where the unit is " +
                    digits(*unit) + " m; this stage has metersPerUnit " + digits(own) +
                    ", so it is " + digits(*value * own) + " m/s^2",
                "leave it out, which means earth, author " + digits(kEarth / own) +
                    ", or correct metersPerUnit");
    }
  }
}

// S-13
void check_radian_targets(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    for (const Token instance : prim.api_instances("PhysicsDriveAPI")) {
      for (const char* what : {"targetPosition", "targetVelocity"}) {
        const Token name("drive:" + instance.str() + ":physics:" + what);
        const std::optional<double> value =
            is_angular_instance(instance) ? authored_number(prim, name) : std::nullopt;
        const std::string fraction = value ? fraction_of_pi(*value) : "";
        if (fraction.empty() || starts_there(subject, prim, *value)) {
          continue;
        }
        report.at(prim, name,
                  name.str() + " is " + digits(*value) + " degrees, which is " + fraction +
                      ": it looks like radians",
                  "author " + digits(*value * kDegreesPerRadian) + " if radians were meant");
      }
    }
  }
}

void check_far_anchor(const Subject& subject, Reporter& report) {
  for (const scene::Joint& joint : subject.scene.joints) {
    for (const auto& [body, frame] :
         {std::pair(joint.body0, joint.frame0), std::pair(joint.body1, joint.frame1)}) {
      const Extent extent = body && joint.enabled ? extent_of(subject, *body) : Extent{};
      const double distance = length(frame.position - extent.middle());
      if (extent.empty() || !(distance > kFarAnchor * extent.half_diagonal()) ||
          !(distance > kNearAnchor)) {
        continue;
      }
      report.at(subject.stage.prim(joint.path),
                "the joint is " + digits(distance) + " m away from the body " +
                    named(subject.scene.bodies[*body].path, RelatedRole::Body) +
                    ", whose colliders reach " + digits(extent.half_diagonal()) + " m",
                "correct the place or its unit: 1 mm is 0.001 m");
      break;
    }
  }
}

void check_far_travel(const Subject& subject, Reporter& report) {
  for (const scene::Joint& joint : subject.scene.joints) {
    const double travel = joint.upper - joint.lower;
    if (joint.kind != scene::JointKind::Prismatic || !std::isfinite(travel)) {
      continue;
    }
    double reach = 0;
    for (const auto& body : {joint.body0, joint.body1}) {
      const Extent extent = body ? extent_of(subject, *body) : Extent{};
      reach = extent.empty() ? reach : std::fmax(reach, extent.half_diagonal());
    }
    if (reach > 0 && travel > kFarTravel * reach) {
      report.at(subject.stage.prim(joint.path), "physics:upperLimit",
                "the joint travels " + digits(travel) + " m, and its bodies reach " +
                    digits(reach) + " m: the limits look like another unit",
                "author them in the stage's unit of length, or leave them open");
    }
  }
}

// S-13
void check_radian_velocity(const Subject& subject, Reporter& report) {
  const Token name("physics:angularVelocity");
  for (const stage::Prim& prim : subject.prims) {
    const stage::Attribute attribute = prim.attribute(name);
    const auto value = attribute.has_authored_value() ? attribute.get_as<Vec3f>() : std::nullopt;
    std::string fractions;
    std::string degrees;
    for (std::size_t i = 0; value && i < 3; ++i) {
      const double part = (*value)[i];
      const std::string fraction = part == 0 ? "0" : fraction_of_pi(part);
      if (fraction.empty()) {
        fractions.clear();
        break;
      }
      fractions += (i == 0 ? "" : ", ") + fraction;
      degrees += (i == 0 ? "" : ", ") + digits(part * kDegreesPerRadian);
    }
    if (!fractions.empty() && fractions != "0, 0, 0") {
      report.at(prim, name,
                "physics:angularVelocity is (" + fractions +
                    ") in degrees per second: it looks like radians",
                "author (" + degrees + ") if radians were meant");
    }
  }
}

}  // namespace tenon::check
