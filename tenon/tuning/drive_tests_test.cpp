// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What is wrong with each joint is planted, and the test has to say it.
#include "tenon/tuning/drive_tests.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tenon/tuning/test_tuning.h"

namespace tenon::tuning {
namespace {

using scene::Axis;
using scene::JointKind;

/// One slider of 2 kg between -0.5 and 0.5, critically damped at 20 rad/s.
class DriveTest : public testing::Test {
 protected:
  DriveTest() : scene_(weightless()) {
    const Index mass = add_body(scene_, 2, {{1, 1, 1}}, {});
    scene::Joint& joint = add_joint(scene_, JointKind::Prismatic, Axis::X, std::nullopt, mass);
    joint.lower = -0.5;
    joint.upper = 0.5;
    add_drive(joint, 800, 80);
  }

  DriveTests run(const DriveTestOptions& options) {
    const dynamics::Multibody multibody(scene_);
    const auto rows = drive_rows(multibody, dynamics::Dynamics(multibody, multibody.start()));
    const MakeSimulation make = [this](const scene::PhysicsScene& scene,
                                       const engines::SimulationOptions& simulation)
        -> Result<std::unique_ptr<engines::Simulation>> {
      const bool floats = scene.scenes[0].gravity == Vec3d{} && load_ != 0 && weighs_;
      auto made = std::make_unique<SpringSimulation>(scene, 2, floats ? 0 : load_);
      made->time_step_ = simulation.time_step > 0 ? simulation.time_step : 0.002;
      made->parts_ = parts_;
      made->stop = stop_;
      made->explodes_above = explodes_above_;
      return std::unique_ptr<engines::Simulation>(std::move(made));
    };
    auto tests = test_drives(scene_, rows, make, options);
    EXPECT_TRUE(tests.has_value());
    return tests.has_value() ? *std::move(tests) : DriveTests();
  }

  static bool says(const DriveTestResult& result, const std::string& part) {
    return std::any_of(result.reasons.begin(), result.reasons.end(),
                       [&](const std::string& one) { return one.find(part) != one.npos; });
  }

  scene::Joint& joint() { return scene_.joints[0]; }

  scene::PhysicsScene scene_;
  int parts_ = 20;
  double load_ = 0;
  bool weighs_ = false;
  double stop_ = scene::kUnlimited;
  double explodes_above_ = scene::kUnlimited;
};

TEST_F(DriveTest, SnapReachesBothLimits) {
  const DriveTests tests = run({});
  ASSERT_EQ(tests.results.size(), 1u);
  const DriveTestResult& result = tests.results[0];
  EXPECT_EQ(result.verdict, Verdict::Pass);
  ASSERT_EQ(result.limits.size(), 2u);
  EXPECT_DOUBLE_EQ(result.limits[0].target, -0.5);
  EXPECT_DOUBLE_EQ(result.limits[1].target, 0.5);
  EXPECT_LT(result.limits[1].settling_time.value_or(9), 1);
  EXPECT_LT(result.limits[1].hold.most, kReached);
  EXPECT_TRUE(result.reasons.empty());
}

TEST_F(DriveTest, SnapOfAWeakDriveIsBlockedAndSaturated) {
  joint().drives[0].max_force = 1;
  load_ = -2;
  const DriveTestResult result = run({}).results.at(0);
  EXPECT_NE(result.verdict, Verdict::Pass);
  EXPECT_TRUE(says(result, "its maxForce is too small"));
  EXPECT_TRUE(says(result, "at its maxForce of 1 N for"));
}

TEST_F(DriveTest, SnapThatFrictionHoldsSaysTheDrive) {
  stop_ = -0.45;  // the simulation here has no friction: nothing moves
  joint().drives[0].max_force = 1;
  joint().friction = 1;
  EXPECT_TRUE(says(run({}).results.at(0), "its maxForce is too small"));
}

TEST_F(DriveTest, SnapThatAVelocityLimitSlowsFails) {
  joint().velocity_limit = 0.02;
  const DriveTestResult result = run({}).results.at(0);
  EXPECT_EQ(result.verdict, Verdict::Fail);
  EXPECT_TRUE(says(result, "the velocity limit of 0.02 m/s: it passes without"));
}

TEST_F(DriveTest, SnapBeforeAnObstacleIsBlocked) {
  stop_ = 0.2;
  const DriveTestResult result = run({}).results.at(0);
  EXPECT_EQ(result.verdict, Verdict::Blocked);
  EXPECT_TRUE(says(result, "a mimic, another joint or a wrong limit: it ends 0.3 m away"));
}

TEST_F(DriveTest, SnapThatSagsSaysTheWeight) {
  scene_.scenes[0].gravity = {{0, 0, -9.81}};
  load_ = -40;  // 0.05 m
  weighs_ = true;
  const DriveTestResult result = run({}).results.at(0);
  EXPECT_EQ(result.verdict, Verdict::Blocked);
  EXPECT_TRUE(says(result, "the weight that it carries"));
  EXPECT_TRUE(says(result, "raise its stiffness"));
}

TEST_F(DriveTest, SnapOfAnOpenJointIsSkipped) {
  joint().upper = scene::kUnlimited;
  const DriveTestResult result = run({}).results.at(0);
  EXPECT_EQ(result.verdict, Verdict::Skipped);
  EXPECT_TRUE(says(result, "no limits"));
}

TEST_F(DriveTest, StepIsTheForm) {
  joint().drives[0].damping = 0.3 * 80;
  DriveTestOptions options;
  options.kind = TestKind::Step;
  const DriveTestResult result = run(options).results.at(0);
  ASSERT_TRUE(result.step.has_value());
  EXPECT_NEAR(result.step->overshoot, overshoot_of(0.3), 0.01);
  EXPECT_NEAR(result.step->rise_time.value_or(0), rise_time_of({20, 0.3}), 0.002);
  EXPECT_TRUE(says(result, "overshoot 37"));
}

TEST_F(DriveTest, ACoarseStepIsFoundToBeTheCause) {
  DriveTestOptions options;
  options.kind = TestKind::Step;
  parts_ = 1;
  for (const double coarse : {0.02, 0.05}) {  // [s]; by the form at a quarter, a sixteenth
    options.time_step = coarse;
    const DriveTestResult result = run(options).results.at(0);
    ASSERT_TRUE(result.form.has_value());
    EXPECT_FALSE(result.form->by_form) << coarse;
    EXPECT_EQ(result.form->causes, std::vector{StepCause::TimeStep}) << coarse;
    EXPECT_TRUE(result.form->without.has_value()) << coarse;
  }
}

TEST_F(DriveTest, SineLagsAsTheForm) {
  DriveTestOptions options;
  options.kind = TestKind::Sine;
  options.period = 1;
  const DriveTestResult result = run(options).results.at(0);
  ASSERT_TRUE(result.sine.has_value());
  const double omega = 2 * 3.14159265358979;
  const double real = 400 - omega * omega;
  const double imaginary = 40 * omega;
  EXPECT_NEAR(result.sine->gain, 400 / std::hypot(real, imaginary), 0.01);
  EXPECT_NEAR(result.sine->lag, std::atan2(imaginary, real) / omega, 0.003);
}

TEST_F(DriveTest, StressFindsWhatExplodes) {
  explodes_above_ = 700;
  DriveTestOptions options;
  options.kind = TestKind::Stress;
  options.duration = 3;
  options.seed = 7;
  const DriveTests tests = run(options);
  EXPECT_EQ(tests.results.at(0).verdict, Verdict::Unstable);
  EXPECT_TRUE(says(tests.results[0], "gains: unstable alone: joint0"));
  EXPECT_EQ(tests.seed, 7u);
}

TEST_F(DriveTest, StressIsTheSameForASeed) {
  DriveTestOptions options;
  options.kind = TestKind::Stress;
  options.duration = 1;
  options.seed = 3;
  const DriveTests first = run(options);
  const DriveTests second = run(options);
  EXPECT_EQ(first.results.at(0).verdict, Verdict::Pass);
  EXPECT_EQ(first.results[0].signal.command, second.results.at(0).signal.command);
  options.seed = 4;
  EXPECT_NE(first.results[0].signal.command, run(options).results.at(0).signal.command);
}

TEST_F(DriveTest, StepsComeCloserToTheFinest) {
  DriveTestOptions options;
  options.kind = TestKind::Steps;
  const DriveTestResult result = run(options).results.at(0);
  ASSERT_EQ(result.steps.size(), 6u);
  EXPECT_DOUBLE_EQ(result.steps[0].time_step, 0.008);
  EXPECT_GT(result.steps[0].gap, result.steps[4].gap);
  EXPECT_EQ(result.steps[5].gap, 0);
}

TEST_F(DriveTest, AStopEndsTheTest) {
  DriveTestOptions options;
  options.go_on = [](double seconds, double) { return seconds < 0.5; };
  EXPECT_TRUE(run(options).interrupted);
}

TEST_F(DriveTest, TooManySamplesAreRefused) {
  const dynamics::Multibody multibody(scene_);
  const auto rows = drive_rows(multibody, dynamics::Dynamics(multibody, multibody.start()));
  const MakeSimulation make =
      [](const scene::PhysicsScene& scene,
         const engines::SimulationOptions&) -> Result<std::unique_ptr<engines::Simulation>> {
    auto made = std::make_unique<SpringSimulation>(scene, 2, 0);
    made->time_step_ = 1e-7;
    return std::unique_ptr<engines::Simulation>(std::move(made));
  };
  const auto tests = test_drives(scene_, rows, make, {});
  ASSERT_FALSE(tests.has_value());
  EXPECT_EQ(tests.error().code(), ErrorCode::Limit);
}

TEST(SceneWithout, SelfCollisionIsOffWithinWhatJointsHold) {
  scene::PhysicsScene scene = weightless();
  const Index a = add_body(scene, 1, {{1, 1, 1}}, {});
  const Index b = add_body(scene, 1, {{1, 1, 1}}, {});
  const Index c = add_body(scene, 1, {{1, 1, 1}}, {});
  const Index other = add_body(scene, 1, {{1, 1, 1}}, {});
  add_joint(scene, JointKind::Revolute, Axis::Y, a, b).collision_enabled = true;
  add_joint(scene, JointKind::Revolute, Axis::Y, b, c).collision_enabled = true;
  for (const Index body : {a, b, c, other}) {
    scene::Collider collider;
    collider.path = *Path::parse("/collider" + std::to_string(body));
    collider.body = body;
    scene.colliders.push_back(collider);
  }
  EXPECT_TRUE(scene.may_collide(0, 2));
  const scene::PhysicsScene apart = without_self_collision(scene);
  EXPECT_FALSE(apart.may_collide(0, 1));
  EXPECT_FALSE(apart.may_collide(0, 2));
  EXPECT_TRUE(apart.may_collide(0, 3));
}

}  // namespace
}  // namespace tenon::tuning
