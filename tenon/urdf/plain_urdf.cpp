// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// URDF 1.0, as ROS documents it and urdfdom and its like parse it. A ball turns about x, then y,
// then z of its child's frame, each carried by the one before: any rotation is such a turn, but
// near a right angle about y the other two hinges have one axis. Engines refuse links that move and
// weigh nothing, so each link between has a millionth of the child's inertia.
#include "tenon/urdf/plain_urdf.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "tenon/base/file_finding.h"
#include "tenon/base/text/unique_names.h"

namespace tenon::urdf {

using robot::GeometryKind;
using robot::Index;
using robot::JointKind;

namespace {

constexpr std::size_t kNamed = 20;      // joints that one message names
constexpr double kAlmostNone = 1e-6;    // of the child's mass and inertia
constexpr double kLeastInertia = 1e-9;  // [kg], [kg m^2] where the child has none

class Replacement {
 public:
  Replacement(robot::RobotModel& model, Diagnostics& diagnostics)
      : model_(model), diagnostics_(diagnostics) {
    for (const robot::Link& link : model.links) {
      names_.take(link.name);
    }
    for (const robot::Joint& joint : model.joints) {
      names_.take(joint.name);
    }
  }

  void run() {
    for (robot::Link& link : model_.links) {
      split_capsules(link.visuals);
      split_capsules(link.colliders);
    }
    if (capsules_ > 0) {
      report(Severity::Info,
             std::to_string(capsules_) +
                 " capsules, which URDF does not support, are written as a cylinder "
                 "and two spheres each");
    }
    const std::size_t count = model_.joints.size();
    for (std::size_t i = 0; i < count; ++i) {
      robot::Joint& joint = model_.joints[i];
      if (joint.kind == JointKind::Ball) {
        spread_ball(i);  // says what becomes of it
        continue;
      }
      bound_slide(joint);
      if (joint.has_one_axis()) {
        limit(joint.effort_limit, joint.name, without_effort_);
        limit(joint.velocity_limit, joint.name, without_speed_);
      }
    }
    report_unlimited(without_effort_, "effort");
    report_unlimited(without_speed_, "speed");
  }

 private:
  void report(Severity severity, std::string message) {
    diagnostics_.add(file_finding(severity, "urdf.replaced", std::move(message), ""));
  }

  template <class Shape>
  void split_capsules(std::vector<Shape>& shapes) {
    std::vector<Shape> result;
    for (Shape& shape : shapes) {
      if (shape.geometry.kind != GeometryKind::Capsule) {
        result.push_back(std::move(shape));
        continue;
      }
      ++capsules_;
      const double half_height = shape.geometry.half_height;
      if (half_height > 0) {
        result.push_back(shape);
        result.back().geometry.kind = GeometryKind::Cylinder;
      }
      for (const double end : {half_height, -half_height}) {
        Shape& ball = result.emplace_back(shape);
        ball.geometry.kind = GeometryKind::Sphere;
        ball.pose = shape.pose * Pose{{{0, 0, end}}, kIdentityRotation};
        ball.name += ball.name.empty() ? "" : end < 0 ? "_bottom" : "_top";
        if (half_height == 0) {
          ball.name = shape.name;
          break;
        }
      }
    }
    shapes = std::move(result);
  }

  Index add_link(const std::string& name, const robot::Link& child) {
    robot::Link link;
    link.name = names_.make(name);
    robot::Inertial& inertial = link.inertial.emplace();
    inertial.mass = kLeastInertia;
    inertial.inertia = Mat3d{};
    double moment = kLeastInertia;
    if (child.inertial && child.inertial->mass > 0) {
      const Mat3d whole = child.inertial->inertia_in_link();
      inertial.mass = kAlmostNone * child.inertial->mass;
      moment = kAlmostNone * std::max({whole[0][0], whole[1][1], whole[2][2]});
    }
    for (std::size_t k = 0; k < 3; ++k) {
      inertial.inertia[k][k] = moment;
    }
    model_.links.push_back(std::move(link));
    return static_cast<Index>(model_.links.size() - 1);
  }

  /// The joint itself becomes the first hinge.
  void spread_ball(std::size_t number) {
    const std::string name = model_.joints[number].name;
    const Index child = model_.joints[number].child;
    const robot::Link on_it = model_.links[child];
    const std::array<Index, 2> between = {add_link(name + "_x_link", on_it),
                                          add_link(name + "_y_link", on_it)};
    report(Severity::Warning,
           "the ball \"" + name +
               "\", which URDF does not support, is written as three hinges with "
               "two links of a millionth of the mass of \"" +
               on_it.name + "\"; near a right angle of the second they lose a direction");
    robot::Joint& first = model_.joints[number];
    first.kind = JointKind::Continuous;
    first.axis = {{1, 0, 0}};
    first.frame = {};
    first.child = between[0];
    first.name = names_.make(name + "_x");
    std::array<robot::Joint, 2> more = {first, first};
    for (std::size_t i = 0; i < more.size(); ++i) {
      more[i].origin = {};
      more[i].axis = i == 0 ? Vec3d{{0, 1, 0}} : Vec3d{{0, 0, 1}};
      more[i].name = names_.make(name + (i == 0 ? "_y" : "_z"));
      more[i].parent = between[i];
      more[i].child = i == 0 ? between[1] : child;
    }
    model_.joints.insert(model_.joints.end(), more.begin(), more.end());
  }

  /// Without an end, readers take both for 0, which locks the joint.
  void bound_slide(robot::Joint& joint) {
    const bool needs = joint.kind == JointKind::Prismatic || joint.kind == JointKind::Revolute;
    if (needs && !joint.limit) {
      joint.limit = robot::Limit{-kNoUrdfLimit, kNoUrdfLimit};
      report(Severity::Warning, "the range of joint \"" + joint.name +
                                    "\" has no end, which URDF cannot say; it is written as 1e9 " +
                                    (joint.kind == JointKind::Prismatic ? "m" : "rad") +
                                    " both ways, which this program reads as no limit");
    }
  }

  static void limit(double& value, const std::string& joint, std::vector<std::string>& without) {
    if (!(value < kNoUrdfLimit)) {
      value = kNoUrdfLimit;
      without.push_back(joint);
    }
  }

  /// Names the joints that got kNoUrdfLimit.
  void report_unlimited(const std::vector<std::string>& joints, const std::string& of) {
    if (joints.empty()) {
      return;
    }
    std::string names;
    for (std::size_t i = 0; i < std::min(joints.size(), kNamed); ++i) {
      names += (i == 0 ? "\"" : ", \"") + joints[i] + "\"";
    }
    if (joints.size() > kNamed) {
      names += " and " + std::to_string(joints.size() - kNamed) + " more";
    }
    report(Severity::Warning, (joints.size() == 1 ? "joint " : "joints ") + names +
                                  (joints.size() == 1 ? " has" : " have") + " no limit of " + of +
                                  ", which URDF requires; 1e9 is written, which this program reads "
                                  "as no limit and others as a limit");
  }

  robot::RobotModel& model_;
  Diagnostics& diagnostics_;
  UniqueNames names_;
  std::size_t capsules_ = 0;
  std::vector<std::string> without_effort_;
  std::vector<std::string> without_speed_;
};

}  // namespace

void make_plain(robot::RobotModel& model, Diagnostics& diagnostics) {
  Replacement(model, diagnostics).run();
}

}  // namespace tenon::urdf
