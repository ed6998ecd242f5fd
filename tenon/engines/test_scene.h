// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "tenon/scene/physics_scene.h"

/// Neutral scenes made by hand, for the tests of engines only.
namespace tenon::engines {

inline constexpr double kG = 9.81;  // [m/s^2]

inline Path named(const std::string& name) { return Path::from("/" + name); }

struct TestScene : scene::PhysicsScene {
  explicit TestScene(double g = kG) { scenes.push_back({named("Scene"), {{0, 0, -g}}, {}}); }

  scene::Index add_body(const std::string& name, const Vec3d& position, double mass = 1,
                        const Vec3d& inertia = {{0.1, 0.1, 0.1}}) {
    scene::Body body;
    body.path = named(name);
    body.pose.position = position;
    body.mass = mass;
    body.inertia = diagonal(inertia);
    bodies.push_back(body);
    return static_cast<scene::Index>(bodies.size() - 1);
  }

  scene::Index add_collider(const std::string& name, std::optional<scene::Index> body,
                            const scene::Shape& shape, const Pose& pose = {}) {
    scene::Collider collider;
    collider.path = named(name);
    collider.body = body;
    collider.shape = shape;
    collider.pose = pose;
    colliders.push_back(collider);
    filter.groups_of_collider.emplace_back();
    return static_cast<scene::Index>(colliders.size() - 1);
  }

  scene::Joint& add_joint(const std::string& name, scene::JointKind kind,
                          std::optional<scene::Index> body0, std::optional<scene::Index> body1,
                          scene::Axis axis = scene::Axis::Z) {
    scene::Joint joint;
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

inline scene::Shape box(const Vec3d& half_extents) {
  scene::Shape shape;
  shape.kind = scene::ShapeKind::Box;
  shape.half_extents = half_extents;
  return shape;
}

inline scene::Shape sphere(double radius) {
  scene::Shape shape;
  shape.kind = scene::ShapeKind::Sphere;
  shape.radius = radius;
  return shape;
}

inline scene::Shape ground() {
  scene::Shape shape;
  shape.kind = scene::ShapeKind::Plane;
  return shape;
}

inline scene::Drive drive(scene::Dof dof, double stiffness, double damping) {
  scene::Drive result;
  result.dof = dof;
  result.stiffness = stiffness;
  result.damping = damping;
  return result;
}

}  // namespace tenon::engines
