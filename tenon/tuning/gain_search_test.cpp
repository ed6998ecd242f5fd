// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Goals whose softest gains the closed form tells, and steps whose causes are planted.
#include "tenon/tuning/gain_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "tenon/tuning/optimizer.h"
#include "tenon/tuning/test_tuning.h"

namespace tenon::tuning {
namespace {

using scene::Axis;
using scene::JointKind;

constexpr double kMass = 2;  // [kg]

scene::PhysicsScene slider() {
  scene::PhysicsScene scene = weightless();
  const Index mass = add_body(scene, kMass, {{1, 1, 1}}, {});
  scene::Joint& joint = add_joint(scene, JointKind::Prismatic, Axis::X, std::nullopt, mass);
  joint.lower = -0.5;
  joint.upper = 0.5;
  add_drive(joint, 800, 80);
  return scene;
}

std::vector<DriveRow> rows_of(const scene::PhysicsScene& scene) {
  const dynamics::Multibody multibody(scene);
  return drive_rows(multibody, dynamics::Dynamics(multibody, multibody.start()));
}

/// What moves `kMass + payload`, and weighs `load` [N].
SearchScene search_scene(scene::PhysicsScene scene, double payload = 0, double load = 0) {
  SearchScene made;
  made.name = std::to_string(payload);
  made.engine = "physx";
  made.scene = std::make_unique<scene::PhysicsScene>(std::move(scene));
  made.rows = rows_of(*made.scene);
  made.make = [payload, load](const scene::PhysicsScene& of,
                              const engines::SimulationOptions& options)
      -> Result<std::unique_ptr<engines::Simulation>> {
    auto simulation = std::make_unique<SpringSimulation>(of, kMass + payload, load);
    simulation->time_step_ = options.time_step > 0 ? options.time_step : 0.002;
    return std::unique_ptr<engines::Simulation>(std::move(simulation));
  };
  return made;
}

GainSearchResult search(const std::vector<SearchScene>& scenes, const SearchOptions& options) {
  SearchedDrive drive;
  drive.load = scenes.front().rows.front().load;
  drive.rows.assign(scenes.size(), 0);
  auto found = search_gains(scenes, {drive}, options);
  EXPECT_TRUE(found.has_value());
  return found.has_value() ? *std::move(found) : GainSearchResult();
}

std::vector<SearchScene> one_scene(scene::PhysicsScene scene) {
  std::vector<SearchScene> scenes;
  scenes.push_back(search_scene(std::move(scene)));
  return scenes;
}

/// Whether the form alone meets the goal.
bool form_meets(const Response& response, const StepGoal& goal) {
  if (overshoot_of(response.ratio) > goal.overshoot) {
    return false;
  }
  for (double time = goal.settling; time < 5 * goal.settling; time += goal.settling / 200) {
    if (std::fabs(step_response(response, time) - 1) > 0.02) {
      return false;
    }
  }
  return true;
}

class GainSearchTest : public testing::Test {
 protected:
  void SetUp() override {
    if (optimizer_version().empty()) {
      GTEST_SKIP() << "no NLopt here";
    }
  }
};

TEST_F(GainSearchTest, OptimizerFindsABoundMinimum) {
  Problem problem;
  problem.start = {2, 2};
  problem.lower = {0.1, 0.1};
  problem.upper = {5, 5};
  problem.step = {0.5, 0.5};
  problem.constraint_count = 1;
  problem.most_tries = 200;
  std::vector<double> last;
  const auto done = minimize(problem, [&](const std::vector<double>& point, bool&) {
    last = point;
    return Tried{point[0] + point[1], {1 - point[0] * point[1]}};
  });
  ASSERT_TRUE(done.has_value());
  ASSERT_EQ(last.size(), 2u);
  EXPECT_NEAR(last[0], 1, 0.05);
  EXPECT_NEAR(last[1], 1, 0.05);
}

TEST_F(GainSearchTest, OptimizerStopsWhenItIsTold) {
  Problem problem;
  problem.start = {2};
  problem.lower = {0};
  problem.upper = {5};
  problem.step = {1};
  int tries = 0;
  const auto done = minimize(problem, [&](const std::vector<double>& point, bool& stop) {
    stop = ++tries == 3;
    return Tried{point[0], {}};
  });
  EXPECT_TRUE(done.has_value());
  EXPECT_LE(tries, 4);
}

TEST_F(GainSearchTest, TheSoftestThatMeetsTheGoal) {
  SearchOptions options;
  const auto found = search(one_scene(slider()), options);
  ASSERT_EQ(found.drives.size(), 1u);
  const FoundGains& drive = found.drives[0];
  EXPECT_TRUE(drive.met);
  EXPECT_LE(drive.overshoot, 0.01);
  EXPECT_LE(drive.settling_time.value_or(9), 0.2);
  // The form at a fifth less does not meet it, whatever the ratio.
  for (double ratio = 0.3; ratio < 3; ratio += 0.01) {
    EXPECT_FALSE(form_meets({0.8 * drive.response.frequency, ratio}, options.goal)) << ratio;
  }
  const auto again = search(one_scene(slider()), options);
  EXPECT_EQ(again.drives[0].response.frequency, drive.response.frequency);
  EXPECT_EQ(again.drives[0].response.ratio, drive.response.ratio);
}

TEST_F(GainSearchTest, EveryPayloadMeetsTheGoal) {
  std::vector<SearchScene> scenes = one_scene(slider());
  scenes.push_back(search_scene(slider(), 2));
  SearchOptions options;
  options.goal = {0.05, 0.3};
  const auto found = search(scenes, options);
  ASSERT_EQ(found.drives.size(), 1u);
  EXPECT_TRUE(found.drives[0].met);
  const auto alone = search(one_scene(slider()), options);
  EXPECT_GT(found.drives[0].response.frequency, alone.drives[0].response.frequency);
}

TEST_F(GainSearchTest, WhatTheDriveCannotDoIsMissed) {
  scene::PhysicsScene weak = slider();
  weak.joints[0].drives[0].max_force = 0.5;
  const auto found = search(one_scene(weak), {});
  ASSERT_EQ(found.drives.size(), 1u);
  EXPECT_FALSE(found.drives[0].met);
  ASSERT_FALSE(found.drives[0].reasons.empty());
  EXPECT_NE(found.drives[0].reasons[0].find("at its maxForce of 0.5 N"), std::string::npos);
}

TEST_F(GainSearchTest, AnInterruptEndsIt) {
  SearchOptions options;
  options.go_on = [](double, double) { return false; };
  const auto found = search(one_scene(slider()), options);
  EXPECT_TRUE(found.interrupted);
  EXPECT_TRUE(found.drives.empty());
}

/// The step of the slider.
DriveTestResult step_of(const scene::PhysicsScene& scene, double load) {
  const MakeSimulation make = [load](const scene::PhysicsScene& of,
                                     const engines::SimulationOptions& options)
      -> Result<std::unique_ptr<engines::Simulation>> {
    const bool weightless = of.scenes[0].gravity == Vec3d{};
    auto simulation = std::make_unique<SpringSimulation>(of, kMass, weightless ? 0 : load);
    simulation->time_step_ = options.time_step > 0 ? options.time_step : 0.002;
    return std::unique_ptr<engines::Simulation>(std::move(simulation));
  };
  DriveTestOptions options;
  options.kind = TestKind::Step;
  auto tests = test_drives(scene, rows_of(scene), make, options);
  EXPECT_TRUE(tests.has_value() && tests->results.size() == 1);
  return tests.has_value() && !tests->results.empty() ? std::move(tests->results[0])
                                                      : DriveTestResult();
}

std::vector<StepCause> causes_of(const scene::PhysicsScene& scene, double load = 0) {
  const DriveTestResult result = step_of(scene, load);
  EXPECT_TRUE(result.form && !result.form->by_form && result.form->without);
  return result.form ? result.form->causes : std::vector<StepCause>{};
}

TEST(StepCauses, AStepByItsFormHasNone) {
  const DriveTestResult result = step_of(slider(), 0);
  ASSERT_TRUE(result.form);
  EXPECT_TRUE(result.form->by_form);
  EXPECT_TRUE(result.form->causes.empty());
}

TEST(StepCauses, WhatIsPlantedIsFound) {
  scene::PhysicsScene slow = slider();
  slow.joints[0].velocity_limit = 0.2;
  EXPECT_EQ(causes_of(slow), std::vector{StepCause::VelocityLimit});
  scene::PhysicsScene weak = slider();
  weak.joints[0].drives[0].max_force = 8;  // the step asks for 80
  EXPECT_EQ(causes_of(weak), std::vector{StepCause::MaxForce});
  weak.joints[0].velocity_limit = 0.2;
  EXPECT_EQ(causes_of(weak), (std::vector{StepCause::VelocityLimit, StepCause::MaxForce}));
  scene::PhysicsScene heavy = slider();
  heavy.scenes[0].gravity = {{-9.81, 0, 0}};
  EXPECT_EQ(causes_of(heavy, -kMass * 9.81), std::vector{StepCause::Gravity});
  heavy.joints[0].drives[0].max_force = 20;  // the weight is nearly that, and alone the cause
  EXPECT_EQ(causes_of(heavy, -kMass * 9.81), std::vector{StepCause::Gravity});
}

}  // namespace
}  // namespace tenon::tuning
