// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/test_scene.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Index;
using scene::JointKind;

struct Sums {
  Vec3d linear;
  Vec3d angular;
};

Sums momentum_of(const scene::PhysicsScene& scene, const MujocoSimulation& sim) {
  Sums sum;
  for (Index b = 0; b < scene.bodies.size(); ++b) {
    const scene::BodyState state = sim.body_state(b);
    const scene::Body& body = scene.bodies[b];
    const Vec3d local = rotate(conjugate(state.pose.orientation), state.angular_velocity);
    const Vec3d center = transform_point(state.pose, body.center_of_mass);
    sum.linear += state.linear_velocity * body.mass;
    sum.angular += rotate(state.pose.orientation, local * body.inertia) +
                   cross(center, state.linear_velocity * body.mass);
  }
  return sum;
}

void expect_near(const Vec3d& a, const Vec3d& b, double tolerance, const std::string& what) {
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(a[i], b[i], tolerance) << what << " " << i;
  }
}

struct Kind {
  const char* name;
  JointKind kind;
  std::vector<scene::Limit> limits;
};

std::vector<Kind> kinds() {
  using scene::Dof;
  const auto locked = [](std::initializer_list<Dof> dofs) {
    std::vector<scene::Limit> limits;
    for (const Dof dof : dofs) {
      limits.push_back({dof, 1, -1});
    }
    return limits;
  };
  return {{"fixed", JointKind::Fixed, {}},
          {"hinge", JointKind::Revolute, {}},
          {"slide", JointKind::Prismatic, {}},
          {"spherical", JointKind::Spherical, {}},
          {"ball with slides", JointKind::D6, locked({Dof::TransZ})},
          {"universal", JointKind::D6, locked({Dof::TransX, Dof::TransY, Dof::TransZ, Dof::RotY})},
          {"planar", JointKind::D6, locked({Dof::TransZ, Dof::RotX, Dof::RotY})}};
}

// Two rotated bodies whose joint is at an angle; the second one moves and spins.
TestScene pair_of(const Kind& kind, bool first_moves, bool reversed) {
  TestScene scene(0);
  const Index a = scene.add_body("A", {{0, 0, 5}}, 1, {{0.1, 0.2, 0.25}});
  const Index b = scene.add_body("B", {{0.3, 0.1, 4}}, 2, {{0.3, 0.2, 0.4}});
  scene.bodies[b].pose.orientation = rotation_about(normalized(Vec3d{{1, 2, 3}}), 0.7);
  scene.bodies[b].center_of_mass = {{0.05, 0.1, -0.02}};
  scene::Body& moving = scene.bodies[first_moves ? a : b];
  moving.linear_velocity = {{1, -0.5, 0.25}};
  moving.angular_velocity = {{0.5, 0.3, -0.4}};
  scene::Joint& joint =
      scene.add_joint("J", kind.kind, reversed ? b : a, reversed ? a : b, scene::Axis::Y);
  joint.limits = kind.limits;
  const Pose at{{{0.1, 0.2, 4.6}}, rotation_about(normalized(Vec3d{{2, -1, 1}}), 0.4)};
  joint.frame0 = inverse(scene.bodies[*joint.body0].pose) * at;
  joint.frame1 = inverse(scene.bodies[*joint.body1].pose) * at;
  return scene;
}

TEST(StartVelocities, JointedBodiesKeepTheirMomentumWhicheverIsTheRoot) {
  for (const Kind& kind : kinds()) {
    for (const bool first_moves : {true, false}) {
      std::vector<Vec3d> first_speeds;
      for (const bool reversed : {false, true}) {
        const TestScene scene = pair_of(kind, first_moves, reversed);
        const auto sim = simulation(scene, 0.0005);
        ASSERT_NE(sim, nullptr);
        const scene::Body& moving = scene.bodies[first_moves ? 0 : 1];
        const Vec3d center = transform_point(moving.pose, moving.center_of_mass);
        const Vec3d local = rotate(conjugate(moving.pose.orientation), moving.angular_velocity);
        const Sums before{moving.linear_velocity * moving.mass,
                          rotate(moving.pose.orientation, local * moving.inertia) +
                              cross(center, moving.linear_velocity * moving.mass)};
        const std::string what = kind.name;
        Sums now = momentum_of(scene, *sim);
        expect_near(now.linear, before.linear, 1e-9, what + " start, linear");
        expect_near(now.angular, before.angular, 1e-9, what + " start, angular");
        for (const Index b : {0u, 1u}) {
          first_speeds.push_back(sim->body_state(b).linear_velocity);
          first_speeds.push_back(sim->body_state(b).angular_velocity);
        }
        run(*sim, 0.2);
        now = momentum_of(scene, *sim);
        expect_near(now.linear, before.linear, 2e-3, what + " later, linear");
        expect_near(now.angular, before.angular, 1e-2, what + " later, angular");
      }
      for (std::size_t i = 0; i < 4; ++i) {
        expect_near(first_speeds[i], first_speeds[i + 4], 1e-9, std::string(kind.name) + " root");
      }
    }
  }
}

// Four bars in a ring, with hinges that need a coordinate: the one that closes it has it on an
// auxiliary body, which the velocities are to fit too.
TEST(StartVelocities, AClosedLoopStartsWithVelocitiesThatFitIt) {
  TestScene scene(0);
  const Vec3d corners[] = {{{1, 1, 0}}, {{-1, 1, 0}}, {{-1, -1, 0}}, {{1, -1, 0}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3d center = (corners[i] + corners[(i + 1) % 4]) * 0.5;
    scene.add_body("B" + std::to_string(i), center, 1 + 0.5 * static_cast<double>(i));
  }
  for (Index i = 0; i < 4; ++i) {
    const Index next = (i + 1) % 4;
    scene::Joint& joint =
        scene.add_joint("J" + std::to_string(i), JointKind::Revolute, i, next, scene::Axis::Z);
    joint.frame0.position = corners[next] - scene.bodies[i].pose.position;
    joint.frame1.position = corners[next] - scene.bodies[next].pose.position;
    joint.lower = -2;
    joint.upper = 2;
  }
  scene.bodies[0].linear_velocity = {{0, 1, 0.5}};
  Diagnostics findings;
  const auto sim = simulation(scene, 0.001, &findings);
  ASSERT_NE(sim, nullptr);
  expect_near(momentum_of(scene, *sim).linear, {{0, 1, 0.5}}, 1e-9, "start");
  double around = 0;  // the corners of a closed loop turn by nothing in all
  for (Index j = 0; j < 4; ++j) {
    around += sim->joint_state(j).velocity.at(0);
    const scene::BodyState a = sim->body_state(j);
    const scene::BodyState b = sim->body_state((j + 1) % 4);
    const Vec3d gap =
        b.linear_velocity + cross(b.angular_velocity, scene.joints[j].frame1.position) -
        a.linear_velocity - cross(a.angular_velocity, scene.joints[j].frame0.position);
    expect_near(gap, {}, 1e-9, "corner " + std::to_string(j));
  }
  EXPECT_NEAR(around, 0, 1e-9);
  ASSERT_FALSE(findings.items().empty());
  EXPECT_EQ(findings.items()[0].rule, "joint.velocities-apart");
  run(*sim, 0.1);
  expect_near(momentum_of(scene, *sim).linear, {{0, 1, 0.5}}, 1e-2, "later");
}

// A bob hangs still while what holds it moves on: its end is pulled, v = u / (1 + m r^2 / I).
TEST(StartVelocities, ABobUnderAMovingKinematicBodyStartsNearlyAtRest) {
  TestScene scene;
  const Index holder = scene.add_body("Holder", {{0, 0, 5}});
  const Index bob = scene.add_body("Bob", {{0, 0, 4}}, 1, {{0.01, 0.01, 0.01}});
  scene.bodies[holder].kinematic = true;
  scene.pose_tracks.push_back({holder, {}, {0, 2}, {Pose{{{0, 0, 5}}}, Pose{{{2, 0, 5}}}}});
  scene.add_joint("J", JointKind::Spherical, holder, bob).frame1.position = {{0, 0, 1}};
  const auto sim = simulation(scene);
  ASSERT_NE(sim, nullptr);
  EXPECT_NEAR(sim->body_state(bob).linear_velocity[0], 1 / 101.0, 1e-6);
  EXPECT_NEAR(sim->body_state(holder).linear_velocity[0], 1, 1e-9);
}

// Two that move apart are joined in mid-run: a plastic impact.
TEST(StartVelocities, AJointThatIsSwitchedOnKeepsTheMomentum) {
  TestScene scene(0);
  scene.add_body("A", {{0, 0, 0}});
  scene.add_body("B", {{0, 0, -1}});
  scene.bodies[0].linear_velocity = {{1, 0, 0}};
  scene::Joint& joint =
      scene.add_joint("J", JointKind::Revolute, Index{0}, Index{1}, scene::Axis::Y);
  joint.frame0.position = {{0, 0, -0.5}};
  joint.frame1.position = {{0, 0, 0.5}};
  joint.enabled = false;
  scene.switch_tracks.push_back({scene::Switch::JointEnabled, 0, {0, 0.02}, {0, 1}});
  const auto sim = simulation(scene);
  ASSERT_NE(sim, nullptr);
  run(*sim, 0.05);
  EXPECT_NEAR(momentum_of(scene, *sim).linear[0], 1, 1e-3);
  EXPECT_GT(sim->body_state(1).linear_velocity[0], 0.1);
}

}  // namespace
}  // namespace tenon::engines::mujoco
