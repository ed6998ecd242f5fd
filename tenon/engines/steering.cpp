// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Every number that enters an engine passes here once, whether a program sets it or a saved state
// brings it: indices that exist, counts that fit, finite numbers, positive masses. Engines can rely
// on it and need no checks of their own.
#include "tenon/engines/steering.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace tenon::engines {
namespace {

using scene::Index;
using scene::PhysicsScene;

Result<void> check_index(std::size_t index, std::size_t count, const char* what) {
  if (index < count) {
    return {};
  }
  return bad_argument("there is no " + std::string(what) + " " + std::to_string(index) +
                      "; the scene has " + std::to_string(count));
}

Result<void> check_numbers(std::span<const double> numbers, const char* what) {
  if (std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); })) {
    return {};
  }
  return bad_argument(std::string(what) + " must be finite numbers");
}

Result<void> check_count(const scene::Joint& joint, std::size_t given, std::size_t wanted) {
  if (given == wanted) {
    return {};
  }
  return bad_argument("the joint " + joint.path.str() + " has " + std::to_string(wanted) +
                      " degrees of freedom, not " + std::to_string(given));
}

Result<void> check_pose_values(const Pose& pose) {
  return is_usable(pose)
             ? Result<void>()
             : bad_argument("a pose must be finite, with an orientation that is not zero");
}

}  // namespace

bool is_usable(const Pose& pose) {
  return is_finite(pose) && dot(pose.orientation, pose.orientation) > 1e-12;
}

Error bad_argument(std::string message) {
  return Error(ErrorCode::Invalid, std::move(message)).with_rule("simulation.argument");
}

std::vector<Vec3d> Steering::gravity_of(const PhysicsScene& scene) const {
  std::vector<Vec3d> result;
  for (Index i = 0; i < scene.scenes.size(); ++i) {
    const auto set = gravity.find(i);
    result.push_back(set != gravity.end() ? set->second : scene.scenes[i].gravity);
  }
  return result;
}

Result<void> check_body(const PhysicsScene& scene, Index body) {
  return check_index(body, scene.bodies.size(), "body");
}

Result<void> check_joint(const PhysicsScene& scene, Index joint) {
  return check_index(joint, scene.joints.size(), "joint");
}

Result<void> check_target(const PhysicsScene& scene, Index joint, Index drive,
                          const DriveTarget& target) {
  TENON_CHECK(check_joint(scene, joint));
  TENON_CHECK(check_index(drive, scene.joints[joint].drives.size(), "drive"));
  return check_numbers(std::vector<double>{target.position, target.velocity}, "targets");
}

Result<void> check_efforts(const PhysicsScene& scene, Index joint, std::span<const double> efforts,
                           std::size_t dof_count) {
  TENON_CHECK(check_joint(scene, joint));
  TENON_CHECK(check_count(scene.joints[joint], efforts.size(), dof_count));
  return check_numbers(efforts, "efforts");
}

Result<void> check_wrench(const PhysicsScene& scene, Index body, const Wrench& wrench) {
  TENON_CHECK(check_body(scene, body));
  TENON_CHECK(check_numbers(wrench.force.v, "forces"));
  return check_numbers(wrench.torque.v, "torques");
}

Result<void> check_pose(const PhysicsScene& scene, Index body, const Pose& pose) {
  TENON_CHECK(check_body(scene, body));
  TENON_CHECK(check_pose_values(pose));
  return scene.bodies[body].kinematic
             ? Result<void>()
             : bad_argument("the body " + scene.bodies[body].path.str() + " is not kinematic");
}

Result<void> check_gravity(const PhysicsScene& scene, Index index, const Vec3d& gravity) {
  TENON_CHECK(check_index(index, scene.scenes.size(), "physics scene"));
  return check_numbers(gravity.v, "gravity");
}

Result<void> check_parameter(const PhysicsScene& scene, const ParameterKey& key, double value) {
  switch (key.what) {
    case Parameter::BodyMass:
      TENON_CHECK(check_body(scene, key.object));
      break;
    case Parameter::ColliderFriction:
      TENON_CHECK(check_index(key.object, scene.colliders.size(), "collider"));
      break;
    case Parameter::DriveStiffness:
    case Parameter::DriveDamping:
    case Parameter::DriveMaxForce:
      TENON_CHECK(check_joint(scene, key.object));
      TENON_CHECK(check_index(key.part, scene.joints[key.object].drives.size(), "drive"));
      break;
    case Parameter::JointDamping:
    case Parameter::JointFriction:
    case Parameter::JointArmature:
      TENON_CHECK(check_joint(scene, key.object));
      break;
  }
  const bool open = key.what == Parameter::DriveMaxForce && value == scene::kUnlimited;
  const bool positive = key.what == Parameter::BodyMass ? value >= 1e-9 : value >= 0;
  if (!positive || (!std::isfinite(value) && !open)) {
    return bad_argument(std::string(parameter_name(key.what)) + " cannot be " +
                        std::to_string(value));
  }
  return {};
}

Result<void> check_joint_state(const PhysicsScene& scene, Index joint, const JointState& state,
                               std::size_t dof_count) {
  TENON_CHECK(check_joint(scene, joint));
  TENON_CHECK(check_count(scene.joints[joint], state.position.size(), dof_count));
  TENON_CHECK(check_count(scene.joints[joint], state.velocity.size(), dof_count));
  TENON_CHECK(check_numbers(state.position, "positions"));
  return check_numbers(state.velocity, "velocities");
}

Result<void> check_body_state(const PhysicsScene& scene, Index body, const BodyState& state) {
  TENON_CHECK(check_body(scene, body));
  TENON_CHECK(check_pose_values(state.pose));
  TENON_CHECK(check_numbers(state.linear_velocity.v, "velocities"));
  return check_numbers(state.angular_velocity.v, "velocities");
}

Result<void> check_steering(const PhysicsScene& scene, const Steering& steering,
                            std::span<const std::size_t> dof_counts) {
  for (const auto& [at, target] : steering.targets) {
    TENON_CHECK(check_target(scene, at.first, at.second, target));
  }
  for (const auto& [joint, efforts] : steering.efforts) {
    TENON_CHECK(check_index(joint, dof_counts.size(), "joint"));
    TENON_CHECK(check_efforts(scene, joint, efforts, dof_counts[joint]));
  }
  for (const auto& [body, wrench] : steering.wrenches) {
    TENON_CHECK(check_wrench(scene, body, wrench));
  }
  for (const auto& [body, pose] : steering.poses) {
    TENON_CHECK(check_body(scene, body));
    TENON_CHECK(check_pose_values(pose));
  }
  for (const auto& [index, gravity] : steering.gravity) {
    TENON_CHECK(check_gravity(scene, index, gravity));
  }
  for (const auto& [key, value] : steering.parameters) {
    TENON_CHECK(check_parameter(scene, key, value));
  }
  return {};
}

}  // namespace tenon::engines
