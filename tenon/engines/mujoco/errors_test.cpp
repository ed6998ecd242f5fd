// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/mujoco/mujoco_engine.h"
#include "tenon/engines/mujoco/test_scene.h"

namespace tenon::engines::mujoco {
namespace {

TEST(Errors, FatalErrorOfMuJoCoBecomesOurs) {
  std::vector<std::string> warnings;
  const Result<void> result = guarded(
      [] {
        mju_warning("a warning of %d", 7);
        mju_error("no room for %d", 42);
      },
      &warnings);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code(), ErrorCode::Invalid);
  EXPECT_NE(result.error().message().find("no room for 42"), std::string::npos);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("a warning of 7"), std::string::npos);
}

TEST(Errors, GuardsNest) {
  bool went_on = false;
  const Result<void> outer = guarded([&] {
    if (!guarded([] { mju_error("inner"); }).has_value()) {
      went_on = true;
    }
    mju_error("outer");
  });
  EXPECT_TRUE(went_on);
  ASSERT_FALSE(outer.has_value());
  EXPECT_NE(outer.error().message().find("outer"), std::string::npos);
}

TEST(Errors, RejectedModelSaysWhy) {
  TestScene scene;
  const auto body = scene.add_body("Body", {});
  physics::TriangleMesh speck;  // a hull of 1e-6 m: MuJoCo finds no volume in it
  speck.points = {{{0, 0, 0}}, {{1e-6, 0, 0}}, {{0, 1e-6, 0}}, {{0, 0, 1e-6}}};
  scene.meshes.push_back(speck);
  physics::Shape shape;
  shape.kind = physics::ShapeKind::ConvexHull;
  scene.add_collider("Speck", body, shape);
  Diagnostics findings;
  const auto made = make_simulation(scene, {}, findings);
  ASSERT_FALSE(made.has_value());
  EXPECT_EQ(made.error().code(), ErrorCode::Invalid);
  EXPECT_EQ(made.error().diagnostic().rule, "mujoco.model-rejected");
  EXPECT_NE(made.error().message().find("/Speck"), std::string::npos) << made.error().message();
}

TEST(Errors, UnstableSimulationNamesTimeAndBody) {
  TestScene scene;
  const auto body = scene.add_body("Rocket", {});
  scene.bodies[body].linear_velocity = {{1e9, 0, 0}};
  scene.bodies[body].linear_damping = 0;
  auto sim = simulation(scene, 1.0);
  Result<void> result;
  for (int i = 0; i < 100 && result.has_value(); ++i) {
    result = sim->step();
  }
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code(), ErrorCode::Unstable);
  EXPECT_EQ(result.error().diagnostic().prim, "/Rocket");
}

TEST(Errors, SceneWithoutSceneIsInvalid) {
  Diagnostics findings;
  const auto made = make_simulation(physics::PhysicsScene{}, {}, findings);
  ASSERT_FALSE(made.has_value());
  EXPECT_EQ(made.error().code(), ErrorCode::Invalid);
}

TEST(Errors, EmptySceneStepsOn) {
  TestScene scene;
  auto sim = simulation(scene);
  run(*sim, 0.1);
  EXPECT_EQ(sim->dof_count(), 0u);
}

TEST(Errors, InfoNamesTheLibrary) {
  const EngineInfo info = mujoco::info();
  EXPECT_EQ(info.name, "mujoco");
  EXPECT_TRUE(info.available);
  EXPECT_FALSE(info.version.empty());
}

TEST(Errors, LargeStepsOfAnAssetAreDivided) {
  TestScene scene;
  scene.scenes[0].time_step = 1.0 / 60;
  Diagnostics findings;
  const auto made = make_simulation(scene, {}, findings);
  ASSERT_TRUE(made.has_value());
  EXPECT_NEAR((*made)->time_step(), 1.0 / 300, 1e-12);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings.items()[0].rule, "mujoco.time-step");
}

}  // namespace
}  // namespace tenon::engines::mujoco
