// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tenon/engines/mujoco/test_scene.h"

namespace tenon::engines::mujoco {
namespace {

TEST(FreeBodies, FallWithGravity) {
  TestScene scene;
  scene.add_body("Ball", {{1, 2, 10}});
  auto sim = simulation(scene, 0.001);
  run(*sim, 1);
  // z = z0 - g t^2 / 2; the semi-implicit step adds g t dt / 2 to the way: n (n + 1) / 2 of g dt^2.
  const double way = kG * (1 + 0.001) / 2;
  EXPECT_NEAR(sim->body_state(0).pose.position[2], 10 - way, 1e-9);
  EXPECT_NEAR(sim->body_state(0).linear_velocity[2], -kG, 1e-9);
  EXPECT_NEAR(sim->time(), 1, 1e-12);
}

TEST(FreeBodies, CentreOfMassMovesStraightWhileTheBodySpins) {
  TestScene scene(0);
  const auto body = scene.add_body("Odd", {{0, 0, 0}}, 2, {{0.3, 0.2, 0.1}});
  scene.bodies[body].center_of_mass = {{0.4, 0.4, 0.4}};
  scene.bodies[body].linear_velocity = {{1, 0, 0}};
  scene.bodies[body].angular_velocity = {{0, 0, 5}};
  auto sim = simulation(scene);
  run(*sim, 2);
  const BodyState state = sim->body_state(body);
  const Vec3d com = transform_point(state.pose, scene.bodies[body].center_of_mass);
  // No force: the centre of mass moves by v t, the momentum stays.
  EXPECT_NEAR(com[0], 0.4 + 2, 1e-9);
  EXPECT_NEAR(com[1], 0.4, 1e-9);
  EXPECT_NEAR(com[2], 0.4, 1e-9);
  EXPECT_NEAR(state.linear_velocity[0], 1, 1e-12);
}

TEST(FreeBodies, SpinAboutAPrincipalAxisGoesOnAtItsRate) {
  TestScene scene(0);
  const auto body = scene.add_body("Top", {{0, 0, 0}}, 1, {{0.1, 0.2, 0.3}});
  scene.bodies[body].angular_velocity = {{0, 0, M_PI / 2}};
  auto sim = simulation(scene);
  run(*sim, 1);
  // Angle = w t: a quarter turn in one second (E-29).
  const Vec3d turn = rotation_vector(sim->body_state(body).pose.orientation);
  EXPECT_NEAR(turn[2], M_PI / 2, 1e-6);
}

TEST(FreeBodies, GravityScaleAndKinematicBodiesAreHonoured) {
  TestScene scene;
  const auto half = scene.add_body("Half", {{0, 0, 0}});
  const auto still = scene.add_body("Still", {{0, 0, 5}});
  scene.bodies[half].gravity_scale = 0.5;
  scene.bodies[still].kinematic = true;
  auto sim = simulation(scene);
  run(*sim, 1);
  EXPECT_NEAR(sim->body_state(half).linear_velocity[2], -kG / 2, 1e-9);
  EXPECT_EQ(sim->body_state(still).pose.position[2], 5);
  EXPECT_EQ(sim->dof_count(), 6u);
}

TEST(FreeBodies, DampingSlowsDownExponentially) {
  TestScene scene(0);
  const auto body = scene.add_body("Slow", {{0, 0, 0}}, 3);
  scene.bodies[body].linear_velocity = {{2, 0, 0}};
  scene.bodies[body].angular_velocity = {{0, 0, 4}};
  scene.bodies[body].linear_damping = 0.5;
  scene.bodies[body].angular_damping = 1.5;
  auto sim = simulation(scene);
  run(*sim, 1);
  // v = v0 exp(-c t); implicit steps: (1 + c dt)^-n, within c^2 dt t / 2 of it.
  EXPECT_NEAR(sim->body_state(body).linear_velocity[0], 2 * std::exp(-0.5), 1e-3);
  EXPECT_NEAR(sim->body_state(body).angular_velocity[2], 4 * std::exp(-1.5), 4e-3);
}

TEST(FreeBodies, BodiesOfTwoScenesHaveTheirOwnGravityAndDoNotTouch) {
  TestScene scene;
  scene.scenes.push_back({named("Moon"), {{0, 0, -1.62}}, {}});
  const auto a = scene.add_body("Earth", {{0, 0, 10}});
  const auto b = scene.add_body("Lunar", {{0, 0, 10}});
  scene.bodies[b].scene = 1;
  scene.add_collider("EarthShape", a, sphere(0.5));
  scene.add_collider("LunarShape", b, sphere(0.5));
  auto sim = simulation(scene);
  run(*sim, 1);
  EXPECT_NEAR(sim->body_state(a).linear_velocity[2], -kG, 1e-9);
  EXPECT_NEAR(sim->body_state(b).linear_velocity[2], -1.62, 1e-9);
}

TEST(FreeBodies, EnergyOfAFallIsKept) {
  TestScene scene;
  scene.add_body("Ball", {{0, 0, 10}}, 2);
  auto sim = simulation(scene, 0.0001);
  const double start = sim->energy().total();
  EXPECT_NEAR(start, 2 * kG * 10, 1e-9);
  run(*sim, 1);
  // m g h becomes m v^2 / 2; the semi-implicit step loses m g^2 t dt / 2.
  EXPECT_NEAR(sim->energy().total(), start - 2 * kG * kG * 0.0001 / 2, 1e-6);
  EXPECT_NEAR(sim->energy().kinetic, 2 * kG * kG / 2, 1e-6);
}

TEST(FreeBodies, CollisionOfTwoBallsKeepsMomentum) {
  TestScene scene(0);
  const auto a = scene.add_body("A", {{-1, 0, 0}}, 1);
  const auto b = scene.add_body("B", {{1, 0.1, 0}}, 3);
  scene.bodies[a].linear_velocity = {{2, 0, 0}};
  scene.add_collider("ShapeA", a, sphere(0.2));
  scene.add_collider("ShapeB", b, sphere(0.2));
  auto sim = simulation(scene);
  run(*sim, 2);
  const Vec3d momentum =
      sim->body_state(a).linear_velocity * 1 + sim->body_state(b).linear_velocity * 3;
  // m1 v1 + m2 v2 = 2 kg m/s along x throughout.
  EXPECT_NEAR(momentum[0], 2, 1e-6);
  EXPECT_NEAR(momentum[1], 0, 1e-6);
  EXPECT_GT(sim->body_state(b).linear_velocity[0], 0.4);
}

TEST(FreeBodies, SleepsUntilTouched) {
  TestScene scene;
  const auto asleep = scene.add_body("Asleep", {{0, 0, 5}});
  const auto falling = scene.add_body("Falling", {{0, 0, 9}});
  scene.bodies[asleep].starts_asleep = true;
  scene.add_collider("A", asleep, sphere(0.5));
  scene.add_collider("F", falling, sphere(0.5));
  auto sim = simulation(scene);
  run(*sim, 0.7);
  // Contact after a fall of 3 m: t = sqrt(2 h / g) = 0.782 s.
  EXPECT_EQ(sim->body_state(asleep).pose.position[2], 5);
  run(*sim, 0.3);
  EXPECT_LT(sim->body_state(asleep).pose.position[2], 4.9);
}

void give_material(TestScene& scene, scene::Index collider, double friction) {
  scene::Material material;
  material.path = named("Rubber");
  material.static_friction = friction;
  material.dynamic_friction = friction;
  scene.colliders[collider].material = static_cast<scene::Index>(scene.materials.size());
  scene.materials.push_back(material);
}

// One body asleep at 5 m, one that falls on it from 9 m, one that tumbles far away. With `several`
// materials contacts are finished between the parts of a step.
TestScene sleeper_scene(bool several) {
  TestScene scene;
  const auto asleep = scene.add_body("Asleep", {{0, 0, 5}});
  const auto falling = scene.add_body("Falling", {{0, 0, 9}});
  const auto tumbles = scene.add_body("Tumbles", {{9, 0, 900}}, 1, {{0.01, 0.02, 0.03}});
  scene.bodies[asleep].starts_asleep = true;
  scene.bodies[tumbles].angular_velocity = {{0.1, 10, 0.1}};
  scene.add_collider("A", asleep, sphere(0.5));
  const auto shape = scene.add_collider("F", falling, sphere(0.5));
  if (several) {
    give_material(scene, shape, 0.9);
  }
  return scene;
}

std::unique_ptr<MujocoSimulation> by_runge_kutta(const TestScene& scene) {
  Diagnostics findings;
  SimulationOptions options;
  options.time_step = 0.002;
  options.methods.integrator = Integrator::RungeKutta4;
  auto made = MujocoSimulation::make(scene, options, findings);
  EXPECT_TRUE(made.has_value());
  return made.has_value() ? *std::move(made) : nullptr;
}

// Free fall is a parabola, on which the method is exact: 9 - g t^2 / 2, without the g t dt / 2 of
// Euler's. The energy of a body that tumbles stays to 1e-6, of which Euler's loses 1 % a second.
TEST(FreeBodies, SleepersWaitInStepsOfRungeAndKuttaToo) {
  for (const bool several : {false, true}) {
    const TestScene scene = sleeper_scene(several);
    auto sim = by_runge_kutta(scene);
    ASSERT_NE(sim, nullptr);
    EXPECT_TRUE(sim->not_mapped().empty());
    const double energy = sim->energy().total();
    run(*sim, 0.7);
    EXPECT_EQ(sim->body_state(0).pose.position[2], 5);
    EXPECT_NEAR(sim->body_state(1).pose.position[2], 9 - kG * 0.49 / 2, 1e-9);
    EXPECT_NEAR(sim->energy().total(), energy, 1e-6);
    // Contact after a fall of 3 m: t = sqrt(2 h / g) = 0.782 s.
    run(*sim, 0.3);
    EXPECT_LT(sim->body_state(0).pose.position[2], 4.9);
  }
}

// Without gravity what rests stays at rest, awake or asleep: a glancing blow, whose outcome is that
// of the pair's friction, moves both alike.
TEST(FreeBodies, SleepersAreStruckByMaterialsInStepsOfRungeAndKutta) {
  std::vector<BodyState> ends;
  for (const bool asleep : {true, false}) {
    TestScene scene(0);
    const auto rests = scene.add_body("Rests", {{0, 0, 0}});
    const auto flies = scene.add_body("Flies", {{0.5, 0, 1.1}});
    scene.bodies[rests].starts_asleep = asleep;
    scene.bodies[flies].linear_velocity = {{0, 0, -1}};
    scene.add_collider("R", rests, sphere(0.5));
    give_material(scene, scene.add_collider("F", flies, sphere(0.5)), 0.9);
    auto sim = by_runge_kutta(scene);
    ASSERT_NE(sim, nullptr);
    run(*sim, 0.1);
    EXPECT_EQ(length(sim->body_state(rests).linear_velocity), 0);
    run(*sim, 0.5);
    ends.push_back(sim->body_state(rests));
    EXPECT_GT(length(ends.back().angular_velocity), 0.1);
  }
  EXPECT_NEAR(length(ends[0].linear_velocity - ends[1].linear_velocity), 0, 2e-3);
  EXPECT_NEAR(length(ends[0].angular_velocity - ends[1].angular_velocity), 0, 2e-3);
}

TEST(FreeBodies, SleepersWithoutActuationAreSteppedByEulersMethodAndToldSo) {
  TestScene scene = sleeper_scene(true);
  scene.scenes[0].parts.mujoco.emplace();
  scene.scenes[0].parts.mujoco->push_back({"flag:actuation", {0}, ""});
  auto sim = by_runge_kutta(scene);
  ASSERT_NE(sim, nullptr);
  EXPECT_TRUE(mentions(sim->not_mapped(), scene.scenes[0].path.str(), "mjc:option:integrator"));
  run(*sim, 0.7);
  EXPECT_NEAR(sim->body_state(1).pose.position[2], 9 - kG * 0.7 * (0.7 + 0.002) / 2, 1e-9);
}

TEST(FreeBodies, SleepsBesideABodyThatIsFixedToTheWorld) {
  TestScene scene;
  const auto asleep = scene.add_body("Asleep", {{0, 0, 5}});
  const auto held = scene.add_body("Held", {{3, 0, 5}});
  scene.bodies[asleep].starts_asleep = true;
  scene.add_joint("Weld", scene::JointKind::Fixed, {}, held).frame0.position = {{3, 0, 5}};
  auto sim = simulation(scene);
  run(*sim, 0.2);
  EXPECT_EQ(sim->body_state(asleep).pose.position[2], 5);
  EXPECT_NEAR(sim->body_state(held).pose.position[2], 5, 1e-9);
}

TEST(FreeBodies, TinyMassesAreReportedAndRaised) {
  TestScene scene;
  scene.add_body("Dust", {{0, 0, 0}}, 1e-12, {{1e-20, 1e-20, 1e-20}});
  auto sim = simulation(scene);
  EXPECT_TRUE(mentions(sim->not_mapped(), "/Dust", "physics:mass"));
  EXPECT_TRUE(mentions(sim->not_mapped(), "/Dust", "physics:diagonalInertia"));
}

TEST(FreeBodies, InertiaThatBreaksTheTriangleRuleIsUsedAsItIs) {
  TestScene scene(0);
  const auto body = scene.add_body("Odd", {{0, 0, 0}}, 1, {{1, 2, 30}});
  scene.bodies[body].angular_velocity = {{0, 0, 1}};
  auto sim = simulation(scene);
  // Kinetic energy I w^2 / 2 = 15 J.
  EXPECT_NEAR(sim->energy().kinetic, 15, 1e-9);
}

}  // namespace
}  // namespace tenon::engines::mujoco
