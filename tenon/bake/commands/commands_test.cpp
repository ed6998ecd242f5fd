// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bake/commands/commands.h"

#include <cmath>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tenon/bake/commands/commands_from_csv.h"
#include "tenon/bake/run_simulation.h"
#include "tenon/bake/test_still_simulation.h"
#include "tenon/math/angle.h"

namespace tenon::bake {
namespace {

/// A hinge with one drive, and a joint with two along transX and rotX.
scene::PhysicsScene driven_scene() {
  scene::PhysicsScene scene;
  scene.meters_per_unit = 0.01;
  scene.joints.resize(2);
  scene.joints[0].path = Path::from("/A");
  scene.joints[0].kind = scene::JointKind::Revolute;
  scene.joints[0].drives.resize(1);
  scene.joints[0].drives[0].dof = scene::Dof::RotX;
  scene.joints[0].drives[0].target_velocity = 0.5;
  scene.joints[1].path = Path::from("/B");
  scene.joints[1].kind = scene::JointKind::D6;
  scene.joints[1].drives.resize(2);
  scene.joints[1].drives[0].dof = scene::Dof::TransX;
  scene.joints[1].drives[1].dof = scene::Dof::RotX;
  return scene;
}

std::string failure(const std::string& text) {
  const scene::PhysicsScene scene = driven_scene();
  const StillSimulation simulation({1, 2});
  auto commands = commands_from_csv(text, scene, simulation);
  return commands ? std::string() : std::move(commands).error().in_file("c.csv").to_string();
}

TEST(Commands, AreReadInUnitsOfTheStageAndDegrees) {
  const scene::PhysicsScene scene = driven_scene();
  const StillSimulation simulation({1, 2});
  const auto commands = commands_from_csv(
      "\xEF\xBB\xBFtime, /A.target ,/B.target.transX,/B.velocityTarget.rotX,/B.effort.1\r\n"
      "0,180,50,,-3\r\n\n2.5,0,0,90,4\n",
      scene, simulation);
  ASSERT_TRUE(commands.has_value()) << commands.error().to_string();
  EXPECT_EQ(commands->times, (std::vector<double>{0, 2.5}));
  ASSERT_EQ(commands->values.size(), 8u);
  EXPECT_NEAR(commands->values[0], kPi, 1e-15);
  EXPECT_DOUBLE_EQ(commands->values[1], 0.5);
  EXPECT_TRUE(std::isnan(commands->values[2]));
  EXPECT_DOUBLE_EQ(commands->values[3], -3);
  EXPECT_NEAR(commands->values[6], kPi / 2, 1e-15);
  EXPECT_EQ(commands->columns[3].kind, CommandKind::Effort);
  EXPECT_EQ(commands->columns[3].joint, 1u);
  EXPECT_EQ(commands->columns[3].part, 1u);
}

TEST(Commands, WhatCannotBeIsRefusedWithItsPlace) {
  EXPECT_NE(failure("time,/A.tarbet\n").find("1:6"), std::string::npos);
  EXPECT_NE(failure("time,/A.tarbet\n").find("did you mean /A.target?"), std::string::npos);
  EXPECT_NE(failure("time,/B.target\n").find(".target.rotX"), std::string::npos);
  EXPECT_NE(failure("time,/A.effort\n0,1\n0,1\n").find("3:1"), std::string::npos);
  EXPECT_NE(failure("time,/A.effort\n0,-nan\n").find("2:3"), std::string::npos);
  EXPECT_NE(failure("time,/A.effort\n0,1,\n").find("more cells"), std::string::npos);
  EXPECT_NE(failure("\n \n").find("no header"), std::string::npos);
  EXPECT_EQ(failure("time"), "") << "a file without columns commands nothing";
  EXPECT_EQ(failure("time,/A.effort"), "");
}

TEST(Commands, ARowHoldsFromTheFirstStepAtItsTimeAndKeepsWhatTheAssetHas) {
  const scene::PhysicsScene scene = driven_scene();
  StillSimulation simulation({1, 2});  // steps of 0.1 s
  const auto commands =
      commands_from_csv("time,/A.target,/B.effort.1\n0.25,90,\n0.5,,7\n", scene, simulation);
  ASSERT_TRUE(commands.has_value());
  RunOptions options;
  options.duration = 1;
  options.commands = &*commands;
  const bake::Run run = run_simulation(simulation, scene, options);
  EXPECT_FALSE(run.failure.has_value());
  ASSERT_EQ(simulation.set.size(), 2u);
  EXPECT_EQ(simulation.set[0].step, 3u) << "the step that begins at 0.3 s";
  EXPECT_NEAR(simulation.set[0].numbers[0], kPi / 2, 1e-15);
  EXPECT_DOUBLE_EQ(simulation.set[0].numbers[1], 0.5) << "the asset's velocity target";
  EXPECT_EQ(simulation.set[1].step, 5u);
  EXPECT_EQ(simulation.set[1].numbers, (std::vector<double>{0, 7}));
}

TEST(Commands, RowsOutsideOfTheRunAreTold) {
  const auto told = [](std::vector<double> times) {
    Commands commands;
    commands.times = std::move(times);
    Diagnostics found;
    tell_rows_outside(commands, 0.3, found);
    std::string all;
    for (const Diagnostic& finding : found) {
      EXPECT_EQ(finding.rule, "sim.commands");
      all += finding.message + "; ";
    }
    return all;
  };
  EXPECT_EQ(told({0, 0.1, 0.1 + 0.2}), "");
  EXPECT_EQ(told({-2, -1, 0.1}),
            "2 of 3 rows of commands are before time 0, and hold from there like a row of time "
            "0; ");
  EXPECT_EQ(told({0, 5, 6, 7}),
            "3 of 4 rows of commands are not given: the run ends at 0.3 s, before 5 s; ");
}

TEST(Rest, IsToldOnceItHasLastedAndAllCommandsAreGiven) {
  scene::PhysicsScene scene = driven_scene();
  scene.bodies.resize(1);
  StillSimulation simulation({1, 2});
  simulation.moves_until = 0.75;
  RunOptions options;
  options.until_rest.emplace();
  const bake::Run run = run_simulation(simulation, scene, options);
  ASSERT_TRUE(run.rest_since.has_value());
  EXPECT_NEAR(*run.rest_since, 0.8, 1e-9);
  EXPECT_EQ(run.steps, 10u);

  const auto commands = commands_from_csv("time,/A.effort\n2,1\n", scene, simulation);
  StillSimulation waiting({1, 2});
  options.commands = &*commands;
  EXPECT_NEAR(run_simulation(waiting, scene, options).rest_since.value(), 2.1, 1e-9);

  scene.bodies[0].kinematic = true;
  options.commands = nullptr;
  StillSimulation animated({1, 2});
  animated.moves_until = 100;
  EXPECT_TRUE(run_simulation(animated, scene, options).rest_since.has_value());
}

}  // namespace
}  // namespace tenon::bake
