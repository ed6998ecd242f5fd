// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "tenon/base/enum_range.h"
#include "tenon/engines/environments.h"
#include "tenon/engines/sensors.h"
#include "tenon/engines/test_scene.h"
#include "tenon/engines/world.h"

/// What every engine has to do. Who includes it has declared before, in tenon::engines, the types
/// `TestedEngines`: each with engine() and kRounding, the least difference that it can be held to.
/// An engine without an ability says so, and is held to no more.
namespace tenon::engines {
namespace {

constexpr double kStep = 0.01;  // [s]

template <class E>
class EngineInterface : public testing::Test {
 protected:
  EngineInterface() {
    scene.add_body("a", {{0, 0, 5}}, 2, {{0.5, 0.5, 0.5}});
    scene.add_body("b", {{3, 0, 5}}, 1);
    scene.bodies[scene.add_body("moved", {{9, 0, 5}})].kinematic = true;
  }
  World make() {
    Diagnostics diagnostics;
    SimulationOptions options{.time_step = kStep};
    options.outputs = {
        .contacts = true, .efforts = true, .reactions = true, .accelerations = true, .work = true};
    auto made = E::engine().make(scene, options, diagnostics);
    EXPECT_TRUE(made.has_value());
    return World(*std::move(made));
  }
  static void run(World& world, std::size_t steps) {
    const Result<void> done = world.step(steps);
    ASSERT_TRUE(done.has_value()) << done.error().to_string();
  }
  static void same(const World& one, const World& other, std::size_t bodies) {
    EXPECT_EQ(one.time(), other.time());
    for (scene::Index b = 0; b < bodies; ++b) {
      const BodyState x = one.body_state(b);
      const BodyState y = other.body_state(b);
      EXPECT_EQ(x.pose, y.pose);
      EXPECT_EQ(x.linear_velocity, y.linear_velocity);
      EXPECT_EQ(x.angular_velocity, y.angular_velocity);
    }
  }
  /// A bound of a difference, wide enough for what the engine's numbers resolve.
  static double within(double bound) { return std::max(bound, E::kRounding); }
  /// Something of everything.
  static void steer(World& world) {
    EXPECT_TRUE(world.set_body_wrench(0, {{{1, 2, 3}}, {{0.1, 0, 0.2}}}).has_value());
    EXPECT_TRUE(world.set_gravity(0, {{0, 0, -2}}).has_value());
    EXPECT_TRUE(world.set_parameter({Parameter::BodyMass, 1, 0}, 3).has_value());
    EXPECT_TRUE(world.move_kinematic(2, {{{9, 1, 5}}}).has_value());
  }
  TestScene scene;
};

TYPED_TEST_SUITE(EngineInterface, TestedEngines);

TYPED_TEST(EngineInterface, GravityThatIsSetActsFromTheNextStepOn) {
  World world = this->make();
  this->run(world, 10);
  EXPECT_NEAR(world.body_state(0).linear_velocity[2], -kG * 0.1, this->within(1e-12));
  ASSERT_TRUE(world.set_gravity(0, {{1, 0, 0}}).has_value());
  this->run(world, 10);
  EXPECT_NEAR(world.body_state(0).linear_velocity[2], -kG * 0.1, this->within(1e-12));
  EXPECT_NEAR(world.body_state(0).linear_velocity[0], 0.1, this->within(1e-12));
}

// An accelerometer feels forces, not gravity: F / m, and beside the centre w' x r + w x (w x r).
TYPED_TEST(EngineInterface, ImusReadWhatForcesDoAndTurnWithTheirBodies) {
  scene::Sensor imu;
  imu.kind = scene::SensorKind::Imu;
  imu.body = 0;
  this->scene.sensors.push_back(imu);
  imu.pose.position = {{0.2, 0, 0}};
  this->scene.sensors.push_back(imu);
  Diagnostics diagnostics;
  SimulationOptions options{.time_step = kStep};
  options.outputs.sensors = true;
  options.outputs = with_needs_of_sensors(options.outputs, this->scene);
  auto made = TypeParam::engine().make(this->scene, options, diagnostics);
  ASSERT_TRUE(made.has_value());
  auto with_sensors = World::with_sensors(*std::move(made), this->scene);
  ASSERT_TRUE(with_sensors.has_value());
  World& world = *with_sensors;
  this->run(world, 5);
  EXPECT_NEAR(length((*world.sensors())[0].linear_acceleration), 0, this->within(1e-9));
  ASSERT_TRUE(world.set_body_wrench(0, {{{0, 0, 4}}, {{0, 0, 1}}}).has_value());
  this->run(world, 11);
  const std::vector<SensorReading> read = *world.sensors();
  EXPECT_NEAR(read[0].linear_acceleration[2], 4.0 / 2, this->within(1e-9));
  const double spin = 10 * kStep * 1 / 0.5;  // at the beginning of the last step
  EXPECT_NEAR(read[1].linear_acceleration[0], -spin * spin * 0.2, this->within(1e-9));
  EXPECT_NEAR(read[1].linear_acceleration[1], 1 / 0.5 * 0.2, this->within(1e-9));
  EXPECT_NEAR(read[1].angular_velocity[2], spin * 1.1, this->within(1e-9));
  ASSERT_TRUE(world.reset().has_value());
  EXPECT_EQ((*world.sensors())[0].time, 0);
}

// v = t F / m and w = t T / I.
TYPED_TEST(EngineInterface, WrenchesAccelerateAtTheCentreOfMass) {
  World world = this->make();
  ASSERT_TRUE(world.set_gravity(0, {}).has_value());
  ASSERT_TRUE(world.set_body_wrench(0, {{{4, 0, 0}}, {{0, 0, 1}}}).has_value());
  this->run(world, 10);
  EXPECT_NEAR(world.body_state(0).linear_velocity[0], 0.1 * 4 / 2, this->within(1e-12));
  EXPECT_NEAR(world.body_state(0).angular_velocity[2], 0.1 * 1 / 0.5, this->within(1e-12));
  const BodyAcceleration acceleration = *world.body_acceleration(0);
  EXPECT_NEAR(acceleration.linear[0], 2, this->within(1e-9));
  EXPECT_NEAR(acceleration.angular[2], 2, this->within(1e-9));
  EXPECT_NEAR(world.body_acceleration(1)->linear[0], 0, this->within(1e-12));
}

TYPED_TEST(EngineInterface, AForceAtAPointTurnsTheBody) {
  World world = this->make();
  ASSERT_TRUE(world.set_gravity(0, {}).has_value());
  const Vec3d point = world.center_of_mass(0) + Vec3d{{0, 0.5, 0}};
  ASSERT_TRUE(world.set_body_force_at(0, {{4, 0, 0}}, point).has_value());
  this->run(world, 1);
  EXPECT_NEAR(world.body_state(0).angular_velocity[2], -0.01 * 0.5 * 4 / 0.5, this->within(1e-12));
}

TYPED_TEST(EngineInterface, AFallingBodyHasTheAccelerationOfGravity) {
  World world = this->make();
  this->run(world, 3);
  EXPECT_NEAR(world.body_acceleration(0)->linear[2], -kG, this->within(1e-9));
}

TYPED_TEST(EngineInterface, AMassThatIsSetTakesItsInertiaAlong) {
  World world = this->make();
  ASSERT_TRUE(world.set_gravity(0, {}).has_value());
  ASSERT_TRUE(world.set_parameter({Parameter::BodyMass, 0, 0}, 8).has_value());
  ASSERT_TRUE(world.set_body_wrench(0, {{{4, 0, 0}}, {{0, 0, 1}}}).has_value());
  this->run(world, 10);
  EXPECT_NEAR(world.body_state(0).linear_velocity[0], 0.1 * 4 / 8, this->within(1e-12));
  EXPECT_NEAR(world.body_state(0).angular_velocity[2], 0.1 * 1 / 2, this->within(1e-12));
}

TYPED_TEST(EngineInterface, ADriveWhoseGainsAreSetToZeroLetsGo) {
  for (const bool in_tree : {false, true}) {
    this->scene.joints.clear();
    scene::Joint& slide =
        this->scene.add_joint("slide", scene::JointKind::Prismatic, {}, 0, scene::Axis::X);
    slide.frame0.position = {{0, 0, 5}};
    slide.drives.push_back(drive(scene::Dof::TransX, 1e3, 1e2));
    if (in_tree) {
      slide.articulation = 0;
      this->scene.articulations.push_back({named("a"), slide.path, true, {0}, {0}, {}, true, {}});
    }
    World world = this->make();
    ASSERT_TRUE(world.set_parameter({Parameter::DriveStiffness, 0, 0}, 0).has_value());
    ASSERT_TRUE(world.set_parameter({Parameter::DriveDamping, 0, 0}, 0).has_value());
    ASSERT_TRUE(world.set_body_wrench(0, {{{4, 0, 0}}, {}}).has_value());
    this->run(world, 10);
    EXPECT_NEAR(world.body_state(0).linear_velocity[0], 0.1 * 4 / 2, this->within(1e-9)) << in_tree;
  }
}

TYPED_TEST(EngineInterface, AKinematicBodyReachesItsPoseInOneStepAndStays) {
  World world = this->make();
  this->run(world, 2);
  ASSERT_TRUE(world.move_kinematic(2, {{{9, 0.1, 5}}}).has_value());
  this->run(world, 1);
  EXPECT_NEAR(length(world.body_state(2).pose.position - Vec3d{{9, 0.1, 5}}), 0, this->within(0));
  EXPECT_NEAR(world.body_state(2).linear_velocity[1], 10, this->within(1e-9));
  this->run(world, 1);
  EXPECT_NEAR(length(world.body_state(2).pose.position - Vec3d{{9, 0.1, 5}}), 0, this->within(0));
  EXPECT_NEAR(length(world.body_state(2).linear_velocity), 0, this->within(1e-9));
}

TYPED_TEST(EngineInterface, ASetStateIsReadBack) {
  World world = this->make();
  this->run(world, 2);
  const BodyState state{{{{1, 2, 3}}, rotation_about({{0, 0, 1}}, 0.3)}, {{1, 0, 2}}, {{0, 3, 0}}};
  ASSERT_TRUE(world.set_body_state(1, state).has_value());
  EXPECT_NEAR(length(world.body_state(1).pose.position - state.pose.position), 0,
              this->within(1e-12));
  EXPECT_NEAR(length(world.body_state(1).linear_velocity - state.linear_velocity), 0,
              this->within(1e-12));
  EXPECT_NEAR(length(world.body_state(1).angular_velocity - state.angular_velocity), 0,
              this->within(1e-12));
}

TYPED_TEST(EngineInterface, ResetIsAsIfJustMade) {
  World world = this->make();
  this->run(world, 5);
  this->steer(world);
  this->run(world, 5);
  ASSERT_TRUE(world.reset().has_value());
  World fresh = this->make();
  this->same(world, fresh, 3);
  this->run(world, 7);
  this->run(fresh, 7);
  this->same(world, fresh, 3);
}

TYPED_TEST(EngineInterface, ASavedStateContinuesBitForBit) {
  World world = this->make();
  if (!world.can(Ability::SavedStates)) {
    return;
  }
  this->run(world, 5);
  this->steer(world);
  this->run(world, 5);
  const Result<std::string> state = world.save_state();
  ASSERT_TRUE(state.has_value());
  World other = this->make();
  const Result<void> done = other.restore_state(*state);
  ASSERT_TRUE(done.has_value()) << done.error().to_string();
  this->same(world, other, 3);
  this->run(world, 20);
  this->run(other, 20);
  this->same(world, other, 3);
  if (world.can(Ability::Work)) {
    EXPECT_EQ(world.work()->total(), other.work()->total());
  }
  EXPECT_EQ(*world.save_state(), *other.save_state());
}

TYPED_TEST(EngineInterface, StatesThatAreDamagedAreRefusedAndChangeNothing) {
  World world = this->make();
  if (!world.can(Ability::SavedStates)) {
    return;
  }
  this->steer(world);
  this->run(world, 3);
  const std::string state = *world.save_state();
  World other = this->make();
  for (std::size_t length = 0; length < state.size(); length += 7) {
    EXPECT_FALSE(other.restore_state(std::string_view(state).substr(0, length)).has_value());
  }
  for (std::size_t at = 0; at < state.size(); at += 5) {
    std::string damaged = state;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x41);
    const Result<void> done = other.restore_state(damaged);
    ASSERT_FALSE(done.has_value()) << at;
    EXPECT_EQ(done.error().diagnostic().rule, "simulation.state");
  }
  World fresh = this->make();
  this->same(other, fresh, 3);
}

TYPED_TEST(EngineInterface, StatesOfAnotherSceneOrStepAreRefused) {
  World world = this->make();
  if (!world.can(Ability::SavedStates)) {
    return;
  }
  const std::string state = *world.save_state();
  this->scene.bodies[0].mass = 3;
  World other = this->make();
  const Result<void> done = other.restore_state(state);
  ASSERT_FALSE(done.has_value());
  EXPECT_EQ(done.error().code(), ErrorCode::Unsupported);
}

// Semi-implicit steps lose m g^2 dt^2 / 2 in each (work of gravity g v' against g (v + v') / 2).
TYPED_TEST(EngineInterface, WorkClosesTheBalanceOfAFall) {
  World world = this->make();
  if (!world.can(Ability::Work)) {
    return;
  }
  const double start = world.energy().total();
  this->run(world, 10);
  ASSERT_TRUE(world.set_body_wrench(0, {{{0, 0, 30}}, {}}).has_value());
  ASSERT_TRUE(world.set_gravity(0, {}).has_value());
  this->run(world, 10);
  const double lost = 10 * (2 + 1) * kG * kG * kStep * kStep / 2;
  EXPECT_NEAR(world.energy().total(), start + world.work()->total() - lost, this->within(1e-9));
  EXPECT_NE(world.work()->applied, 0);
  EXPECT_NE(world.work()->changes, 0);
}

TYPED_TEST(EngineInterface, SaysOfEveryAbilityWhetherItIsThere) {
  World world = this->make();
  const auto code = [](const auto& result) {
    return result.has_value() ? std::optional<ErrorCode>() : result.error().code();
  };
  const auto tried = [&](Ability ability) -> std::optional<ErrorCode> {
    switch (ability) {
      case Ability::DriveTargets:
        return code(world.set_drive_target(0, 0, {}));
      case Ability::JointEfforts:
        return code(world.set_joint_efforts(0, {}));
      case Ability::BodyWrenches:
        return code(world.set_body_wrench(0, {}));
      case Ability::KinematicPoses:
        return code(world.move_kinematic(2, {}));
      case Ability::Gravity:
        return code(world.set_gravity(0, {}));
      case Ability::Parameters:
        return code(world.set_parameter({Parameter::BodyMass, 0, 0}, 1));
      case Ability::States:
        return code(world.set_body_state(0, {}));
      case Ability::SavedStates:
        return code(world.save_state());
      case Ability::Contacts:
        return code(world.contacts());
      case Ability::DriveEfforts:
        return code(world.drive_efforts(0));
      case Ability::JointReactions:
        return code(world.joint_reaction(0));
      case Ability::Accelerations:
        return code(world.body_acceleration(0));
      case Ability::Work:
        break;
    }
    return code(world.work());
  };
  for (std::uint8_t i = 0; wire::is_enumerator<Ability>(i); ++i) {
    const auto ability = static_cast<Ability>(i);
    EXPECT_EQ(tried(ability) == ErrorCode::Unsupported, !world.can(ability))
        << ability_name(ability);
  }
}

TYPED_TEST(EngineInterface, RefusesWhatCannotBeUsed) {
  World world = this->make();
  const auto refused = [](const Result<void>& result) {
    return !result.has_value() && result.error().code() == ErrorCode::Invalid &&
           result.error().diagnostic().rule == "simulation.argument";
  };
  const double nan = std::nan("");
  EXPECT_TRUE(refused(world.set_body_wrench(7, {})));
  EXPECT_TRUE(refused(world.set_body_wrench(0, {{{nan, 0, 0}}, {}})));
  EXPECT_TRUE(refused(world.set_gravity(1, {})));
  EXPECT_TRUE(refused(world.move_kinematic(0, {})));
  EXPECT_TRUE(refused(world.move_kinematic(2, {{{nan, 0, 0}}})));
  EXPECT_TRUE(refused(world.set_parameter({Parameter::BodyMass, 0, 0}, 0)));
  EXPECT_TRUE(refused(world.set_parameter({Parameter::ColliderFriction, 0, 0}, 1)));
  EXPECT_TRUE(refused(world.set_body_state(0, {{{{nan, 0, 0}}}, {}, {}})));
}

TYPED_TEST(EngineInterface, OutputsThatAreOffAreNotRead) {
  Diagnostics diagnostics;
  auto made = TypeParam::engine().make(this->scene, {.time_step = kStep}, diagnostics);
  ASSERT_TRUE(made.has_value());
  const World world(*std::move(made));
  if (world.can(Ability::Work)) {
    EXPECT_EQ(world.work().error().diagnostic().rule, "simulation.output-off");
  }
  EXPECT_EQ(world.body_acceleration(0).error().diagnostic().rule, "simulation.output-off");
}

TYPED_TEST(EngineInterface, EnvironmentsHaveValuesOfTheirOwnWhateverTheThreads) {
  std::vector<std::string> states;
  for (const std::size_t threads : {1u, 2u, 3u}) {
    Diagnostics diagnostics;
    auto made =
        Environments::make(TypeParam::engine(), this->scene,
                           {.count = 7, .threads = threads, .simulation = {kStep}}, diagnostics);
    ASSERT_TRUE(made.has_value()) << made.error().to_string();
    Environments& all = *made;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double x = static_cast<double>(i);
      ASSERT_TRUE(all[i].set_gravity(0, {{0, 0, -x}}).has_value());
      ASSERT_TRUE(all[i].set_parameter({Parameter::BodyMass, 0, 0}, 1 + x).has_value());
      ASSERT_TRUE(all[i].set_body_wrench(0, {{{6, 0, 0}}, {}}).has_value());
    }
    EXPECT_EQ(all.step(10), 0u);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double x = static_cast<double>(i);
      EXPECT_NEAR(all[i].body_state(0).linear_velocity[0], 0.6 / (1 + x), this->within(1e-12));
      EXPECT_NEAR(all[i].body_state(1).linear_velocity[2], -0.1 * x, this->within(1e-12));
    }
    std::string together;
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (scene::Index b = 0; b < this->scene.bodies.size(); ++b) {
        const BodyState state = all[i].body_state(b);
        together.append(reinterpret_cast<const char*>(&state), sizeof state);
      }
    }
    states.push_back(std::move(together));
  }
  EXPECT_EQ(states[0], states[1]);
  EXPECT_EQ(states[0], states[2]);
}

}  // namespace
}  // namespace tenon::engines
