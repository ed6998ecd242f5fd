// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Closed forms, and Lagrange's equations by differences of the mass matrix.
#include "tenon/dynamics/dynamics.h"

#include <cmath>

#include <gtest/gtest.h>

namespace tenon::dynamics {
namespace {

using scene::Axis;
using scene::Body;
using scene::Dof;
using scene::Joint;
using scene::JointKind;
using scene::Limit;
using scene::PhysicsScene;

constexpr double kG = 9.81;

PhysicsScene empty_scene() {
  PhysicsScene scene;
  scene.scenes.emplace_back();
  scene.scenes[0].gravity = {{0, 0, -kG}};
  return scene;
}

Index add_body(PhysicsScene& scene, double mass, const Vec3d& moments, const Vec3d& place,
               const Vec3d& center = {}) {
  Body body;
  body.path = *Path::parse("/body" + std::to_string(scene.bodies.size()));
  body.mass = mass;
  body.center_of_mass = center;
  body.inertia = Mat3d{};
  for (std::size_t i = 0; i < 3; ++i) {
    body.inertia[i][i] = moments[i];
  }
  body.pose.position = place;
  scene.bodies.push_back(body);
  return static_cast<Index>(scene.bodies.size() - 1);
}

/// Its frame 1 is at the origin of body1, where body1 is.
Joint& add_joint(PhysicsScene& scene, JointKind kind, Axis axis, std::optional<Index> body0,
                 std::optional<Index> body1) {
  Joint joint;
  joint.path = *Path::parse("/joint" + std::to_string(scene.joints.size()));
  joint.kind = kind;
  joint.axis = axis;
  joint.body0 = body0;
  joint.body1 = body1;
  const Pose world1 = body1 ? scene.bodies[*body1].pose : Pose{};
  joint.frame0 = body0 ? inverse(scene.bodies[*body0].pose) * world1 : world1;
  scene.joints.push_back(joint);
  return scene.joints.back();
}

double held(const PhysicsScene& scene, Index joint) {
  const Multibody multibody(scene);
  const Dynamics dynamics(multibody, multibody.start());
  return dynamics
      .effective_inertia(*multibody.coordinate_of(joint, multibody.dofs()[joint].free[0].dof))
      .held;
}

double free_of_others(const PhysicsScene& scene, Index joint) {
  const Multibody multibody(scene);
  const Dynamics dynamics(multibody, multibody.start());
  return dynamics
      .effective_inertia(*multibody.coordinate_of(joint, multibody.dofs()[joint].free[0].dof))
      .free;
}

// Two point masses on rods, planar: M as in any textbook on the double pendulum.
TEST(Dynamics, DoublePendulumHasTheTextbookMatrix) {
  constexpr double kM1 = 1.5;
  constexpr double kM2 = 0.7;
  constexpr double kL1 = 0.4;
  constexpr double kL2 = 0.3;
  PhysicsScene scene = empty_scene();
  const Index a = add_body(scene, kM1, {}, {}, {{kL1, 0, 0}});
  const Index b = add_body(scene, kM2, {}, {{kL1, 0, 0}}, {{kL2, 0, 0}});
  add_joint(scene, JointKind::Revolute, Axis::Y, std::nullopt, a);
  add_joint(scene, JointKind::Revolute, Axis::Y, a, b);
  const Multibody multibody(scene);
  for (const double q2 : {0.0, 0.8, -2.1}) {
    const Posture posture = multibody.moved(multibody.start(), {{0.3}, {q2}});
    const Dynamics dynamics(multibody, posture);
    const DenseMatrix mass = *dynamics.mass_matrix();
    const double c = std::cos(q2);
    const double m22 = kM2 * kL2 * kL2;
    const double m12 = m22 + kM2 * kL1 * kL2 * c;
    const double m11 = kM1 * kL1 * kL1 + kM2 * (kL1 * kL1 + kL2 * kL2 + 2 * kL1 * kL2 * c);
    EXPECT_NEAR(mass.at(0, 0), m11, 1e-14);
    EXPECT_NEAR(mass.at(0, 1), m12, 1e-14);
    EXPECT_NEAR(mass.at(1, 0), m12, 1e-14);
    EXPECT_NEAR(mass.at(1, 1), m22, 1e-14);
    const EffectiveInertia first = dynamics.effective_inertia(0);
    EXPECT_NEAR(first.held, m11, 1e-13);
    EXPECT_NEAR(first.free, m11 - m12 * m12 / m22, 1e-13);
    // Y turns from z to x: a rod along x at angle q points to (cos q, -sin q) in x and z.
    const std::vector<double> gravity = dynamics.gravity_forces();
    const double along2 = kM2 * kG * kL2 * std::cos(0.3 + q2);
    EXPECT_NEAR(gravity[1], along2, 1e-13);
    EXPECT_NEAR(gravity[0], along2 + (kM1 + kM2) * kG * kL1 * std::cos(0.3), 1e-13);
    const std::vector<double> bias = dynamics.bias_forces({1.1, -0.6});
    const double h = kM2 * kL1 * kL2 * std::sin(q2);
    EXPECT_NEAR(bias[0], -h * (2 * 1.1 * -0.6 + 0.6 * 0.6), 1e-13);
    EXPECT_NEAR(bias[1], h * 1.1 * 1.1, 1e-13);
  }
}

TEST(Dynamics, TwoFloatingBodiesShareTheInertia) {
  PhysicsScene scene = empty_scene();
  const Index a = add_body(scene, 2, {{0.1, 0.2, 0.3}}, {});
  const Index b = add_body(scene, 3, {{0.4, 0.5, 0.6}}, {});
  add_joint(scene, JointKind::Revolute, Axis::Z, a, b);
  EXPECT_NEAR(held(scene, 0), 0.3 * 0.6 / 0.9, 1e-14);
  scene.joints[0].kind = JointKind::Prismatic;
  EXPECT_NEAR(held(scene, 0), 2.0 * 3.0 / 5.0, 1e-14);
  const Multibody multibody(scene);
  const Dynamics dynamics(multibody, multibody.start());
  const std::size_t slide = *multibody.coordinate_of(0, Dof::TransZ);
  const std::vector<double> gravity = dynamics.gravity_forces();
  EXPECT_NEAR(std::abs(dynamics.along_held(slide, gravity)), 3 * kG, 1e-12);
  EXPECT_NEAR(free_of_others(scene, 0), 2.0 * 3.0 / 5.0, 1e-14);
}

TEST(Dynamics, ArmatureAddsAndFollowersMoveAlong) {
  PhysicsScene scene = empty_scene();
  const Index a = add_body(scene, 1, {{0, 0, 0.2}}, {});
  const Index b = add_body(scene, 1, {{0, 0, 0.5}}, {{1, 0, 0}});
  add_joint(scene, JointKind::Revolute, Axis::Z, std::nullopt, a).armature = 0.05;
  add_joint(scene, JointKind::Revolute, Axis::Z, std::nullopt, b);
  EXPECT_NEAR(held(scene, 0), 0.25, 1e-14);
  scene::Mimic mimic;
  mimic.dof = Dof::RotZ;
  mimic.leader = 0;
  mimic.leader_dof = Dof::RotZ;
  mimic.multiplier = -2;
  mimic.offset = 0.1;
  scene.joints[1].mimics.push_back(mimic);
  EXPECT_NEAR(held(scene, 0), 0.25 + 4 * 0.5, 1e-13);
  EXPECT_NEAR(held(scene, 1), 0.25 / 4 + 0.5, 1e-13);
  const Multibody multibody(scene);
  const Posture posture = multibody.moved(multibody.start(), {{0.3}, {0}});
  EXPECT_NEAR(posture.joints[1][0], 0.1 - 0.6, 1e-15);
  const Dynamics dynamics(multibody, posture);
  EXPECT_NEAR(dynamics.along_held(0, {1.5, 0.25}), 1.5 - 2 * 0.25, 1e-13);
}

TEST(Dynamics, WhatHasNoMassHasNoInertiaAndWhatCannotMoveHasAll) {
  PhysicsScene scene = empty_scene();
  const Index a = add_body(scene, 0, {}, {});
  add_joint(scene, JointKind::Revolute, Axis::Z, std::nullopt, a);
  EXPECT_EQ(held(scene, 0), 0);
  scene.bodies[0].mass = 1;
  scene.bodies[0].inertia[2][2] = 1;
  Joint second = scene.joints[0];  // holds the same body at another place: nothing moves
  second.path = *Path::parse("/joint1");
  second.frame0.position = {{1, 0, 0}};
  second.frame1.position = {{1, 0, 0}};
  scene.joints.push_back(second);
  EXPECT_TRUE(std::isinf(held(scene, 0)));
}

// Asked over and over, and in whatever order, the answers stay.
TEST(Dynamics, AskingAgainCostsNothing) {
  PhysicsScene scene = empty_scene();
  constexpr Index kCount = 100;
  for (Index i = 0; i < kCount; ++i) {
    const Index body = add_body(scene, 1, {{1, 1, 1}}, {});
    Joint& joint = add_joint(scene, JointKind::Revolute, Axis::Z, std::nullopt, body);
    if (i > 0) {
      scene::Mimic mimic;
      mimic.dof = Dof::RotZ;
      mimic.leader_dof = Dof::RotZ;
      joint.mimics.push_back(mimic);
    }
  }
  const Multibody multibody(scene);
  const Dynamics dynamics(multibody, multibody.start());
  const std::vector<double> forces(kCount, 1.0);
  for (std::size_t i = 0; i < 40 * kCount; ++i) {
    ASSERT_NEAR(dynamics.effective_inertia(i % kCount).held, kCount, 1e-9);
    ASSERT_NEAR(dynamics.along_held(i % kCount, forces), kCount, 1e-9);
  }
}

// A parallelogram: the coupler moves on a circle without turning, so it counts as a point mass.
TEST(Dynamics, AParallelogramMovesAsAWhole) {
  PhysicsScene scene = empty_scene();
  const Index left = add_body(scene, 1, {{0, 0.02, 0}}, {{0, 0, 0}}, {{0, 0, 0.1}});
  const Index right = add_body(scene, 1, {{0, 0.02, 0}}, {{1, 0, 0}}, {{0, 0, 0.1}});
  const Index coupler = add_body(scene, 3, {{0, 0.7, 0}}, {{0, 0, 0.2}}, {{0.5, 0, 0}});
  add_joint(scene, JointKind::Revolute, Axis::Y, std::nullopt, left);
  add_joint(scene, JointKind::Revolute, Axis::Y, std::nullopt, right);
  add_joint(scene, JointKind::Revolute, Axis::Y, left, coupler);
  Joint closing = scene.joints[2];
  closing.path = *Path::parse("/joint3");
  closing.body0 = right;
  closing.frame0.position = {{0, 0, 0.2}};
  closing.frame1.position = {{1, 0, 0}};
  scene.joints.push_back(closing);
  const double expected = 2 * (0.02 + 1 * 0.1 * 0.1) + 3 * 0.2 * 0.2;
  EXPECT_NEAR(held(scene, 0), expected, 1e-10);
  scene.joints[0].drives.push_back({{}, Dof::RotY});
  const Multibody multibody(scene);
  const Posture posture = multibody.moved(multibody.start(), {{0.4}, {0}, {0}, {0}});
  EXPECT_LT(multibody.loop_gap(posture), 1e-12);
  EXPECT_NEAR(posture.joints[0][0], 0.4, 1e-6);
  EXPECT_NEAR(posture.joints[1][0], posture.joints[0][0], 1e-9);
  EXPECT_NEAR(rotation_vector(posture.bodies[coupler].orientation)[1], 0, 1e-9);
}

/// A tree of joints of each kind, one of them with its sides exchanged.
PhysicsScene mixed_tree() {
  PhysicsScene scene = empty_scene();
  const Index a = add_body(scene, 1.3, {{0.02, 0.03, 0.04}}, {{0, 0, 1}}, {{0.1, 0.02, -0.03}});
  const Index b = add_body(scene, 0.8, {{0.01, 0.02, 0.02}}, {{0.3, 0, 1}}, {{0.05, 0.1, 0}});
  const Index c = add_body(scene, 0.5, {{0.005, 0.004, 0.006}}, {{0.3, 0.2, 1.2}}, {{0, 0.1, 0.1}});
  const Index d = add_body(scene, 0.4, {{0.003, 0.004, 0.005}}, {{0.5, 0.2, 1.1}}, {{0.1, 0, 0.1}});
  add_joint(scene, JointKind::Revolute, Axis::Z, std::nullopt, a);
  add_joint(scene, JointKind::Prismatic, Axis::X, a, b);
  Joint& reversed = add_joint(scene, JointKind::Revolute, Axis::Y, c, b);
  reversed.frame0.position = {{0, -0.2, -0.2}};
  Joint& universal = add_joint(scene, JointKind::D6, Axis::X, c, d);
  for (const Dof dof : {Dof::TransX, Dof::TransY, Dof::RotX}) {
    universal.limits.push_back({dof, 1, -1});
  }
  return scene;
}

TEST(Dynamics, BiasForcesAreThoseOfLagrange) {
  const PhysicsScene scene = mixed_tree();
  const Multibody multibody(scene);
  const std::size_t n = multibody.coordinates().size();
  ASSERT_EQ(n, 6u);
  std::vector<std::vector<double>> q{{0.3}, {0.1}, {-0.7}, {0.2, 0.5, -0.4}};
  ASSERT_EQ(multibody.dofs()[3].count(), 3u);
  const std::vector<double> v{0.9, -0.7, 1.3, 0.4, -1.1, 0.8};
  const auto mass_at = [&](std::size_t k, double h) {
    std::vector<std::vector<double>> moved = q;
    const Coordinate& coordinate = multibody.coordinates()[k];
    moved[*coordinate.joint][coordinate.part] += h;
    return *Dynamics(multibody, multibody.moved(multibody.start(), moved)).mass_matrix();
  };
  std::vector<DenseMatrix> slopes;
  constexpr double kH = 1e-5;
  for (std::size_t k = 0; k < n; ++k) {
    const DenseMatrix above = mass_at(k, kH);
    const DenseMatrix below = mass_at(k, -kH);
    slopes.push_back({n, n, std::vector<double>(n * n)});
    for (std::size_t i = 0; i < n * n; ++i) {
      slopes[k].values[i] = (above.values[i] - below.values[i]) / (2 * kH);
    }
  }
  const Dynamics dynamics(multibody, multibody.moved(multibody.start(), q));
  const std::vector<double> bias = dynamics.bias_forces(v);
  for (std::size_t i = 0; i < n; ++i) {
    double expected = 0;
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t k = 0; k < n; ++k) {
        expected += (slopes[k].at(i, j) - slopes[i].at(j, k) / 2) * v[j] * v[k];
      }
    }
    EXPECT_NEAR(bias[i], expected, 2e-9) << i;
  }
}

TEST(Dynamics, TheJacobianIsTheSlopeOfPositions) {
  const PhysicsScene scene = mixed_tree();
  const Multibody multibody(scene);
  const std::vector<std::vector<double>> q{{0.3}, {0.1}, {-0.7}, {0.2, 0.5, -0.4}};
  const Vec3d local{{0.1, 0.2, -0.3}};
  const Posture posture = multibody.moved(multibody.start(), q);
  const DenseMatrix jacobian =
      Dynamics(multibody, posture).jacobian(3, transform_point(posture.bodies[3], local));
  constexpr double kH = 1e-6;
  for (std::size_t k = 0; k < multibody.coordinates().size(); ++k) {
    std::vector<std::vector<double>> above = q;
    std::vector<std::vector<double>> below = q;
    const Coordinate& coordinate = multibody.coordinates()[k];
    above[*coordinate.joint][coordinate.part] += kH;
    below[*coordinate.joint][coordinate.part] -= kH;
    const Pose up = multibody.moved(posture, above).bodies[3];
    const Pose down = multibody.moved(posture, below).bodies[3];
    const Vec3d velocity = (transform_point(up, local) - transform_point(down, local)) * (0.5 / kH);
    const Vec3d turn = rotation_vector(up.orientation * conjugate(down.orientation)) * (0.5 / kH);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(jacobian.at(i, k), velocity[i], 1e-8);
      EXPECT_NEAR(jacobian.at(3 + i, k), turn[i], 1e-8);
    }
  }
}

TEST(Dynamics, AStartIsWhereTheAssetHasIt) {
  PhysicsScene scene = mixed_tree();
  const Multibody multibody(scene);
  const Posture start = multibody.start();
  for (Index b = 0; b < scene.bodies.size(); ++b) {
    EXPECT_NEAR(length(start.bodies[b].position - scene.bodies[b].pose.position), 0, 1e-14);
  }
  const Dynamics dynamics(multibody, start);
  EXPECT_NEAR(dynamics.mass(), 3.0, 1e-15);
  scene.joints[0].initial_position = 0.5;
  const Posture turned = Multibody(scene).start();
  EXPECT_NEAR(turned.bodies[1].position[0], 0.3 * std::cos(0.5), 1e-14);
}

}  // namespace
}  // namespace tenon::dynamics
