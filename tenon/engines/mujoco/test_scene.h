// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "tenon/engines/mujoco/build.h"
#include "tenon/engines/mujoco/mujoco_simulation.h"
#include "tenon/physics/physics_scene.h"

/// Neutral scenes made by hand, for the tests of this folder only.
namespace tenon::engines::mujoco {

inline constexpr double kG = 9.81;  // [m/s^2]

inline Path named(const std::string& name) { return Path::from("/" + name); }

struct TestScene : physics::PhysicsScene {
  explicit TestScene(double g = kG) { scenes.push_back({named("Scene"), {{0, 0, -g}}, {}}); }

  physics::Index add_body(const std::string& name, const Vec3d& position, double mass = 1,
                          const Vec3d& inertia = {{0.1, 0.1, 0.1}}) {
    physics::Body body;
    body.path = named(name);
    body.pose.position = position;
    body.mass = mass;
    body.inertia = diagonal(inertia);
    bodies.push_back(body);
    return static_cast<physics::Index>(bodies.size() - 1);
  }

  physics::Index add_collider(const std::string& name, std::optional<physics::Index> body,
                              const physics::Shape& shape, const Pose& pose = {}) {
    physics::Collider collider;
    collider.path = named(name);
    collider.body = body;
    collider.shape = shape;
    collider.pose = pose;
    colliders.push_back(collider);
    filter.groups_of_collider.emplace_back();
    return static_cast<physics::Index>(colliders.size() - 1);
  }

  physics::Joint& add_joint(const std::string& name, physics::JointKind kind,
                            std::optional<physics::Index> body0,
                            std::optional<physics::Index> body1,
                            physics::Axis axis = physics::Axis::Z) {
    physics::Joint joint;
    joint.path = named(name);
    joint.kind = kind;
    joint.body0 = body0;
    joint.body1 = body1;
    joint.axis = axis;
    joints.push_back(joint);
    return joints.back();
  }

  static Mat3d diagonal(const Vec3d& d) {
    Mat3d m;
    for (std::size_t i = 0; i < 3; ++i) {
      m[i][i] = d[i];
    }
    return m;
  }
};

inline physics::Shape box(const Vec3d& half_extents) {
  physics::Shape shape;
  shape.kind = physics::ShapeKind::Box;
  shape.half_extents = half_extents;
  return shape;
}

inline physics::Shape sphere(double radius) {
  physics::Shape shape;
  shape.kind = physics::ShapeKind::Sphere;
  shape.radius = radius;
  return shape;
}

inline physics::Shape ground() {
  physics::Shape shape;
  shape.kind = physics::ShapeKind::Plane;
  return shape;
}

inline physics::Drive drive(physics::Dof dof, double stiffness, double damping) {
  physics::Drive result;
  result.dof = dof;
  result.stiffness = stiffness;
  result.damping = damping;
  return result;
}

/// A simulation that is known to be possible; a failed test and nullptr otherwise.
inline std::unique_ptr<MujocoSimulation> simulation(const physics::PhysicsScene& scene,
                                                    double time_step = 0.002,
                                                    Diagnostics* findings = nullptr) {
  Diagnostics own;
  auto made = MujocoSimulation::make(scene, {.time_step = time_step},
                                     findings == nullptr ? own : *findings);
  EXPECT_TRUE(made.has_value()) << (made.has_value() ? "" : made.error().to_string());
  return made.has_value() ? *std::move(made) : nullptr;
}

inline void run(MujocoSimulation& simulation, double seconds) {
  const auto steps = static_cast<int>(std::lround(seconds / simulation.time_step()));
  for (int i = 0; i < steps; ++i) {
    const Result<void> result = simulation.step();
    ASSERT_TRUE(result.has_value()) << result.error().to_string();
  }
}

inline bool mentions(const std::vector<NotMapped>& list, const std::string& prim,
                     const std::string& property) {
  for (const NotMapped& entry : list) {
    if (entry.prim.str() == prim && entry.property == property) {
      return true;
    }
  }
  return false;
}

}  // namespace tenon::engines::mujoco
