// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/write_mjcf.h"

#include <algorithm>
#include <cmath>

#include "tenon/engines/mujoco/test_scene.h"
#include "tenon/scene/filter_sets.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Axis;
using scene::Dof;
using scene::JointKind;

std::string text_of_scene(const scene::PhysicsScene& scene, Diagnostics& findings) {
  const Result<std::string> text = write_mjcf(scene, {}, findings);
  EXPECT_TRUE(text) << (text ? "" : text.error().to_string());
  return text ? *text : std::string();
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// An arm on a hinge, driven.
TestScene arm(const scene::Drive& with) {
  TestScene scene;
  const auto body = scene.add_body("Arm", {}, 2, {{0.1, 0.2, 0.15}});
  scene.bodies[body].center_of_mass = {{0.3, 0, 0}};
  scene.add_joint("Pivot", JointKind::Revolute, {}, body, Axis::Y).drives.push_back(with);
  return scene;
}

TEST(WriteMjcf, DrivesAreActuatorsThatEveryMujocoKnows) {
  Diagnostics findings;
  scene::Drive servo = drive(Dof::RotY, 20, 1);
  servo.max_force = 25;
  const std::string text = text_of_scene(arm(servo), findings);
  EXPECT_FALSE(has(text, "pid"));
  EXPECT_FALSE(has(text, "autoreset"));
  EXPECT_FALSE(has(text, "memory"));
  EXPECT_TRUE(has(text, "gainprm=\"20\" biasprm=\"0 -20 -1\"")) << text;
  EXPECT_TRUE(has(text, "forcerange=\"-25 25\"")) << text;
}

TEST(WriteMjcf, PlainDrivesMoveAsThoseOfRuns) {
  constexpr int kManySteps = 1000;
  for (const double speed : {0.0, 0.7}) {
    for (const double stiffness : {0.0, 20.0}) {
      scene::Drive servo = drive(Dof::RotY, stiffness, 1);
      servo.target_position = 0.5;
      servo.target_velocity = speed;
      servo.max_force = 9;  // less than its weight needs, so that the clamp counts
      const TestScene scene = arm(servo);
      Diagnostics findings;
      auto plain = build_spec(scene, {.time_step = 0.002}, findings, Begin::Start, Purpose::Text);
      auto usual = build_spec(scene, {.time_step = 0.002}, findings);
      ASSERT_TRUE(plain && usual);
      for (int i = 0; i < kManySteps; ++i) {
        mj_step(plain->model.model.get(), plain->model.data.get());
        mj_step(usual->model.model.get(), usual->model.data.get());
        ASSERT_NEAR(plain->model.data->qpos[0], usual->model.data->qpos[0], 1e-12) << i;
      }
      EXPECT_GT(std::fabs(plain->model.data->qpos[0]), 0.1);
    }
  }
}

TEST(WriteMjcf, ADriveThatRunsSolveWithConstraintsIsTold) {
  const auto told = [](const TestScene& scene) {
    Diagnostics findings;
    text_of_scene(scene, findings);
    return std::count_if(findings.begin(), findings.end(), [](const Diagnostic& finding) {
      return finding.severity == Severity::Warning && finding.property == "drive" &&
             finding.prim == "/Pivot";
    });
  };
  TestScene stiff = arm(drive(Dof::RotY, 5000, 500));
  EXPECT_EQ(told(stiff), 1);
  EXPECT_EQ(told(arm(drive(Dof::RotY, 20, 1))), 0);
  stiff.scenes.front().parts.mujoco =
      std::vector<scene::VendorSetting>{{"option:integrator", {}, "implicitfast"}};
  EXPECT_EQ(told(stiff), 0);  // runs have an actuator then, too
}

TEST(WriteMjcf, EffortsWithoutGainsAreLimitsOfJoints) {
  Diagnostics findings;
  scene::Drive motor = drive(Dof::RotY, 0, 0);
  motor.max_force = 50;
  EXPECT_TRUE(has(text_of_scene(arm(motor), findings), "actuatorfrcrange=\"-50 50\""));
  motor.max_force = scene::kUnlimited;
  EXPECT_FALSE(has(text_of_scene(arm(motor), findings), "actuatorfrcrange"));
}

TEST(WriteMjcf, FreeBodiesHaveTheFramesOfTheAsset) {
  TestScene scene;
  const auto body = scene.add_body("Torso", {{0, 0, 1}}, 3, {{0.01, 0.02, 0.025}});
  scene.bodies[body].center_of_mass = {{0.5, 0, 0.25}};
  Diagnostics findings;
  const std::string text = text_of_scene(scene, findings);
  EXPECT_TRUE(has(text, "<body name=\"/Torso\" pos=\"0 0 1\">")) << text;
  EXPECT_TRUE(has(text, "<inertial pos=\"0.5 0 0.25\"")) << text;
}

TEST(WriteMjcf, NumbersHaveAllTheirDigitsAndInertiasPassTheCompiler) {
  TestScene scene;
  scene.add_body("Rounded", {}, 1.0 / 3, {{0.1, 0.2, 0.3 + 1e-9}});
  Diagnostics findings;
  std::string text = text_of_scene(scene, findings);
  EXPECT_TRUE(has(text, "mass=\"0.33333333333333331\"")) << text;
  EXPECT_TRUE(has(text,
                  "diaginertia=\"0.10000000000000001 0.20000000000000001 "
                  "0.30000000000000004\""))
      << text;
  EXPECT_TRUE(findings.empty());
  scene.bodies[0].inertia = TestScene::diagonal({{0.1, 0.1, 0.3}});
  text = text_of_scene(scene, findings);
  EXPECT_TRUE(has(text, "0.20000000000000001\"")) << text;
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ((*findings.begin()).property, "physics:diagonalInertia");
}

TEST(WriteMjcf, WhatStandsStillIsInTheWorldAndTouchesByTheUsualBits) {
  TestScene scene;
  const auto ball = scene.add_body("Ball", {{0, 0, 1}});
  scene.add_collider("Shape", ball, sphere(0.1));
  scene.add_collider("Floor", {}, ground());
  scene.scenes[0].parts.mujoco.emplace();  // with MuJoCo's schema contacts are MuJoCo's own
  Diagnostics findings;
  const std::string text = text_of_scene(scene, findings);
  EXPECT_FALSE(has(text, "Floor.static")) << text;
  EXPECT_FALSE(has(text, "contype")) << text;
  EXPECT_FALSE(has(text, "conaffinity")) << text;
  EXPECT_FALSE(has(text, "solref")) << text;
  scene.scenes[0].parts.mujoco.reset();
  EXPECT_TRUE(has(text_of_scene(scene, findings), "solref"));
}

/// An arm of two links with shapes that are kept apart where `apart` says so.
TestScene linked_arm(bool apart) {
  TestScene scene;
  const auto upper = scene.add_body("Upper", {});
  const auto lower = scene.add_body("Lower", {});
  scene.add_joint("Shoulder", JointKind::Revolute, {}, upper, Axis::Y);
  scene.add_joint("Elbow", JointKind::Revolute, upper, lower, Axis::Y);
  const auto a = scene.add_collider("A", upper, sphere(0.1));
  const auto b = scene.add_collider("B", lower, sphere(0.1));
  if (apart) {
    keep_pairs_apart(scene, {{a, b}});
  }
  return scene;
}

TEST(WriteMjcf, WhatHangsOnAnotherIsKeptApartByMujocoItself) {
  Diagnostics findings;
  const std::string text = text_of_scene(linked_arm(true), findings);
  EXPECT_FALSE(has(text, "exclude")) << text;
  EXPECT_FALSE(has(text, "filterparent")) << text;
  EXPECT_TRUE(has(text_of_scene(linked_arm(false), findings), "filterparent=\"disable\""));
}

}  // namespace
}  // namespace tenon::engines::mujoco
