// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The indices and the tree of the model are sound already. Numbers that no engine can take are left
// out or replaced. Moments that break the triangle inequality are only reported, and so are limits
// that look like degrees.
// Mimics come in two steps: first those that are wrong by themselves, then cycles. A joint has at
// most one leader, so a walk toward the leaders ends at a joint without one or where some walk has
// been. If that was the same walk there is a cycle, which is cut at that joint. No joint is walked
// over twice.
#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>

#include "tenon/base/text/rounded_text.h"
#include "tenon/math/angle.h"
#include "tenon/math/inertia.h"
#include "tenon/math/meant_degrees.h"
#include "tenon/robot/kinematic_tree.h"

namespace tenon::robot {
namespace {

bool finite(const Vec3d& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

bool finite(const Pose& pose) {
  const Quatd& q = pose.orientation;
  return finite(pose.position) && std::isfinite(dot(q, q));
}

bool finite(const Mat3d& m) {
  return finite(Vec3d{m[0]}) && finite(Vec3d{m[1]}) && finite(Vec3d{m[2]});
}

class Sanitizing {
 public:
  Sanitizing(RobotModel& model, Diagnostics& diagnostics)
      : model_(model), diagnostics_(diagnostics) {}

  void run() {
    for (Link& link : model_.links) {
      sanitize_inertial(link);
      sanitize_shapes(link, link.visuals, "visual");
      sanitize_shapes(link, link.colliders, "collision");
    }
    for (Joint& joint : model_.joints) {
      sanitize_frames(joint);
      sanitize_axis(joint);
      sanitize_numbers(joint);
      sanitize_limit(joint);
      sanitize_mimic(joint);
    }
    break_mimic_circles();
  }

 private:
  void report(const Place& place, const char* rule, std::string message, std::string fix,
              Severity severity = Severity::Error) {
    diagnostics_.add(
        model_finding(model_, place, severity, rule, std::move(message), std::move(fix)));
  }

  void sanitize_inertial(Link& link) {
    if (!link.inertial) {
      return;
    }
    Inertial& inertial = *link.inertial;
    const std::string whose = "the inertial of link \"" + link.name + "\" ";
    if (!std::isfinite(inertial.mass) || !finite(inertial.center_of_mass) ||
        !std::isfinite(dot(inertial.axes, inertial.axes)) || !finite(inertial.inertia)) {
      report(inertial.place, "robot.not-finite",
             whose + "has a number that is not finite; it is skipped", "give finite numbers");
      link.inertial.reset();
      return;
    }
    if (inertial.mass < 0) {
      report(inertial.place, "robot.negative-mass", whose + "has a negative mass; it is skipped",
             "give a mass above 0");
      link.inertial.reset();
      return;
    }
    const PrincipalInertia principal = principal_inertia(inertial.inertia);
    if (sanitize_moments(inertial, whose, principal)) {
      return;
    }
    const Vec3d& moments = principal.moments;
    const double sum = moments[0] + moments[1] + moments[2];
    for (std::size_t i = 0; i < 3; ++i) {
      if (sum - 2 * moments[i] < -1e-6 * std::fabs(sum)) {
        report(inertial.place, "robot.inertia-triangle",
               whose +
                   "has a principal moment larger than the sum of the other two, which no body "
                   "has; it is kept as it is",
               "take the inertia from the part's shape and mass", Severity::Warning);
        break;
      }
    }
  }

  /// Engines let no body turn without inertia. A principal moment of 0 becomes the least that a
  /// body with the other two can have, and at least kSlender of the largest; the others stay. Where
  /// two are 0 or one is negative, nothing is known of the body: each gets the mean, as MuJoCo has
  /// it. No inertia at all stays so: it is computed from the colliders.
  bool sanitize_moments(Inertial& inertial, const std::string& whose,
                        const PrincipalInertia& principal) {
    constexpr double kSlender = 1e-3;
    const Vec3d& moments = principal.moments;
    const double sum = moments[0] + moments[1] + moments[2];
    const auto lacks = [&](double moment) { return moment <= 1e-9 * std::fabs(sum); };
    const auto lacking = std::count_if(moments.v.begin(), moments.v.end(), lacks);
    if (inertial.mass == 0 || inertial.inertia == Mat3d{} || lacking == 0) {
      return false;
    }
    std::string done = "it is skipped";
    const auto [least, largest] = std::minmax({moments[0], moments[1], moments[2]});
    if (sum > 0 && lacking == 1 && least >= -1e-6 * sum) {
      const double middle = sum - largest - least;
      const double lifted = std::max(kSlender * largest, largest - middle);
      const auto which = static_cast<std::size_t>(
          std::find_if(moments.v.begin(), moments.v.end(), lacks) - moments.v.begin());
      Vec3d axis;
      axis[which] = 1;
      add_moment(inertial.inertia, rotate(principal.axes, axis), lifted - moments[which]);
      done = rounded_text(lifted) + " kg m^2 is used for it, the others stay";
    } else {
      inertial.inertia = sum > 0 ? diagonal_matrix(Vec3d{{1, 1, 1}} * (sum / 3)) : Mat3d{};
      done = sum > 0 ? "the mean of the three is used for each" : done;
    }
    report(inertial.place, "robot.inertia-not-positive",
           whose + "has " +
               (lacking > 1 ? "principal moments that are" : "a principal moment that is") +
               " not above 0; " + done,
           "take the inertia from the part's shape and mass", Severity::Warning);
    return true;
  }

  /// `moment` more about the unit vector `axis`.
  static void add_moment(Mat3d& inertia, const Vec3d& axis, double moment) {
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 3; ++column) {
        inertia[row][column] += moment * axis[row] * axis[column];
      }
    }
  }

  static bool sized(const Geometry& geometry) {
    const Vec3d& e = geometry.half_extents;
    switch (geometry.kind) {
      case GeometryKind::Box:
      case GeometryKind::Ellipsoid:
        return finite(e) && e[0] > 0 && e[1] > 0 && e[2] > 0;
      case GeometryKind::Sphere:
        return std::isfinite(geometry.radius) && geometry.radius > 0;
      case GeometryKind::Cylinder:
      case GeometryKind::Capsule:
        return std::isfinite(geometry.radius) && geometry.radius > 0 &&
               std::isfinite(geometry.half_height) && geometry.half_height > 0;
      case GeometryKind::Plane:
        return finite(e);
      case GeometryKind::Mesh:
        return finite(geometry.scale) &&
               geometry.scale[0] * geometry.scale[1] * geometry.scale[2] != 0;
    }
    return false;
  }

  /// A shape without an area, as markers have it: nothing of it can be seen.
  static bool is_invisible(const Geometry& geometry) {
    const auto zeros = [](const Vec3d& v) {
      const double least = std::min({v[0], v[1], v[2]});
      return finite(v) && least >= 0 && std::count(v.v.begin(), v.v.end(), 0.0) >= 2;
    };
    switch (geometry.kind) {
      case GeometryKind::Box:
      case GeometryKind::Ellipsoid:
        return zeros(geometry.half_extents);
      case GeometryKind::Sphere:
      case GeometryKind::Cylinder:
      case GeometryKind::Capsule:
        return geometry.radius == 0;
      case GeometryKind::Mesh:
        return zeros(geometry.scale);
      case GeometryKind::Plane:
        break;
    }
    return false;
  }

  template <class Shape>
  void sanitize_shapes(const Link& link, std::vector<Shape>& shapes, const std::string& what) {
    std::vector<Shape> kept;
    for (Shape& shape : shapes) {
      const std::string name(geometry_name(shape.geometry.kind));
      if (!finite(shape.pose)) {
        report(shape.place, "robot.not-finite",
               "a " + what + " of link \"" + link.name +
                   "\" has a pose that is not finite; it is skipped",
               "give finite numbers");
      } else if (!sized(shape.geometry)) {
        const bool nothing = std::is_same_v<Shape, Visual> && is_invisible(shape.geometry);
        report(shape.place, "robot.bad-size",
               "a " + what + " of link \"" + link.name + "\" is a " + name +
                   " of no size; it is skipped",
               "give sizes above 0", nothing ? Severity::Info : Severity::Error);
      } else {
        kept.push_back(std::move(shape));
      }
    }
    shapes = std::move(kept);
  }

  void sanitize_frames(Joint& joint) {
    for (Pose* pose : {&joint.origin, &joint.frame}) {
      if (!finite(*pose)) {
        report(joint.place, "robot.not-finite",
               "the joint \"" + joint.name + "\" has a pose that is not finite; 0 is used",
               "give finite numbers");
        *pose = {};
      }
    }
  }

  void sanitize_axis(Joint& joint) {
    const double size = length(joint.axis);
    if (std::isfinite(size) && size > 0) {
      const Vec3d& a = joint.axis;
      // An axis along a coordinate axis stays exact.
      const bool exact = std::fabs(dot(a, a) - 1) < 1e-15;
      joint.axis = exact ? a : normalized(a);
      return;
    }
    if (joint.has_one_axis() || joint.kind == JointKind::Planar) {
      report(joint.place, "robot.zero-axis",
             "the axis of joint \"" + joint.name + "\" has no direction; 1 0 0 is used",
             "give the axis three numbers that are not all 0");
    }
    joint.axis = {{1, 0, 0}};
  }

  void sanitize_number(const Joint& joint, const char* name, double fallback, double& value) {
    if (std::isnan(value) || value < 0 || (std::isinf(value) && fallback == 0)) {
      report(joint.place, "robot.bad-number",
             std::string("the ") + name + " of joint \"" + joint.name +
                 "\" is negative or not finite; it is skipped",
             "give a number that is not negative");
      value = fallback;
    }
  }

  void sanitize_numbers(Joint& joint) {
    sanitize_number(joint, "effort limit", kUnlimited, joint.effort_limit);
    sanitize_number(joint, "velocity limit", kUnlimited, joint.velocity_limit);
    sanitize_number(joint, "damping", 0, joint.damping);
    sanitize_number(joint, "friction", 0, joint.friction);
    sanitize_number(joint, "armature", 0, joint.armature);
    sanitize_number(joint, "stiffness", 0, joint.stiffness);
    if (!std::isfinite(joint.spring_reference)) {
      report(joint.place, "robot.bad-number",
             "the rest position of the spring of joint \"" + joint.name +
                 "\" is not finite; it is skipped",
             "give a finite number");
      joint.spring_reference = 0;
    }
  }

  void sanitize_limit(Joint& joint) {
    if (!joint.limit) {
      return;
    }
    const Limit& limit = *joint.limit;
    if (std::isnan(limit.lower) || std::isnan(limit.upper)) {
      report(joint.place, "robot.not-finite",
             "a limit of joint \"" + joint.name + "\" is not a number; the joint is unlimited",
             "give finite limits");
      joint.limit.reset();
    } else if (limit.lower > limit.upper) {
      report(joint.place, "robot.limit-order",
             "the lower limit of joint \"" + joint.name +
                 "\" is above the upper one; they are swapped",
             "swap them");
      joint.limit = Limit{limit.upper, limit.lower};
    }
    if (joint.limit && joint.kind == JointKind::Revolute &&
        degrees_were_meant(joint.limit->lower, joint.limit->upper)) {
      const auto radians = [](double degrees) { return rounded_text(degrees / kDegreesPerRadian); };
      report(joint.place, "robot.limits-in-degrees",
             "the limits " + rounded_text(joint.limit->lower) + " and " +
                 rounded_text(joint.limit->upper) + " of joint \"" + joint.name +
                 "\" are radians, and look like degrees",
             "write " + radians(joint.limit->lower) + " and " + radians(joint.limit->upper) +
                 " if degrees were meant",
             Severity::Warning);
    }
  }

  void sanitize_mimic(Joint& joint) {
    if (!joint.mimic) {
      return;
    }
    const Joint& leader = model_.joints[joint.mimic->leader];
    std::string why;
    if (&leader == &joint) {
      why = "follows itself";
    } else if (!joint.has_one_axis() || !leader.has_one_axis()) {
      why = "or its leader has not exactly one degree of freedom";
    } else if (!std::isfinite(joint.mimic->multiplier) || !std::isfinite(joint.mimic->offset)) {
      why = "has a mimic whose numbers are not finite";
    }
    if (!why.empty()) {
      report(joint.mimic->place, "robot.mimic",
             "the joint \"" + joint.name + "\" " + why + "; the mimic is skipped",
             "name another joint with one axis, and finite numbers");
      joint.mimic.reset();
    }
  }

  void break_mimic_circles() {
    constexpr std::size_t kNever = static_cast<std::size_t>(-1);
    std::vector<std::size_t> walked_by(model_.joints.size(), kNever);
    for (std::size_t start = 0; start < model_.joints.size(); ++start) {
      std::size_t at = start;
      while (walked_by[at] == kNever && model_.joints[at].mimic) {
        walked_by[at] = start;
        at = model_.joints[at].mimic->leader;
      }
      Joint& joint = model_.joints[at];
      if (walked_by[at] == start && joint.mimic) {
        report(
            joint.mimic->place, "robot.mimic",
            "the joint \"" + joint.name + "\" follows itself through others; its mimic is skipped",
            "let one joint of the cycle lead");
        joint.mimic.reset();
      }
    }
  }

  RobotModel& model_;
  Diagnostics& diagnostics_;
};

}  // namespace

void sanitize_model(RobotModel& model, Diagnostics& diagnostics) {
  Sanitizing(model, diagnostics).run();
}

}  // namespace tenon::robot
