// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tenon/base/limits/engine_limits.h"
#include "tenon/engines/mujoco/build/model_size.h"
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/mujoco/mujoco_engine.h"
#include "tenon/engines/mujoco/test_scene.h"
#include "tenon/engines/mujoco/write_mjcf.h"

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

/// A ball with a hull of 1e-6 m, in which MuJoCo finds no volume, and a cone of that kind.
scene::Index add_body_with_refused_parts(TestScene& scene) {
  const auto body = scene.add_body("Body", {{0, 0, 2}});
  scene::TriangleMesh speck;
  speck.points = {{{0, 0, 0}}, {{1e-6, 0, 0}}, {{0, 1e-6, 0}}, {{0, 0, 1e-6}}};
  scene.meshes.push_back(speck);
  scene::Shape shape;
  shape.kind = scene::ShapeKind::ConvexHull;
  scene.add_collider("Speck", body, shape);
  scene::Shape cone;
  cone.kind = scene::ShapeKind::Cone;
  cone.radius = 1e-7;
  cone.half_height = 1e-7;
  scene.add_collider("Cone", body, cone);
  scene.add_collider("Ball", body, sphere(0.5));
  scene.add_collider("Ground", {}, ground());
  return body;
}

std::vector<std::string> parts_left_out(const Diagnostics& findings) {
  std::vector<std::string> left_out;
  for (const Diagnostic& finding : findings) {
    if (finding.rule == "mujoco.part-left-out") {
      left_out.push_back(finding.prim);
    }
  }
  std::sort(left_out.begin(), left_out.end());
  return left_out;
}

TEST(Errors, PartThatMuJoCoRefusesIsLeftOutAndSaid) {
  TestScene scene;
  const auto body = add_body_with_refused_parts(scene);
  Diagnostics findings;
  auto sim = simulation(scene, 0.002, &findings);
  run(*sim, 3);
  EXPECT_NEAR(sim->body_state(body).pose.position[2], 0.5, 1e-2);  // on the ball that is left
  EXPECT_EQ(parts_left_out(findings), (std::vector<std::string>{"/Cone", "/Speck"}));
  EXPECT_TRUE(mentions(sim->not_mapped(), "/Speck", "extent"));
}

TEST(Errors, WrittenModelLeavesOutTheSameParts) {
  TestScene scene;
  add_body_with_refused_parts(scene);
  Diagnostics findings;
  const Result<std::string> text = write_mjcf(scene, {}, findings);
  ASSERT_TRUE(text.has_value()) << text.error().to_string();
  EXPECT_EQ(parts_left_out(findings), (std::vector<std::string>{"/Cone", "/Speck"}));
  EXPECT_NE(text->find("\"/Ball\""), std::string::npos);
  EXPECT_EQ(text->find("\"/Cone\""), std::string::npos);
}

TEST(Errors, DegenerateLimitsDoNotSpoilTheModel) {
  constexpr double kInf = scene::kUnlimited;
  for (const auto& [lower, upper] :
       {std::pair(kInf, kInf), std::pair(-kInf, -kInf), std::pair(kInf, -kInf),
        std::pair(0.0, 1e-8), std::pair(1e12, 2e12), std::pair(0.0, 0.0)}) {
    TestScene scene;
    const auto body = scene.add_body("Body", {});
    scene::Joint& joint = scene.add_joint("Joint", scene::JointKind::D6, {}, body);
    joint.limits.push_back({scene::Dof::RotX, lower, upper});
    joint.limits.push_back({scene::Dof::TransX, lower, upper});
    auto sim = simulation(scene);
    ASSERT_NE(sim, nullptr) << lower << " " << upper;
    run(*sim, 0.01);
  }
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
  const auto made = make_simulation(scene::PhysicsScene{}, {}, findings);
  ASSERT_FALSE(made.has_value());
  EXPECT_EQ(made.error().code(), ErrorCode::Invalid);
}

TEST(Errors, ChainsThatMujocoRefusesAreToldAtOnce) {
  const auto chain = [](int count) {
    TestScene scene;
    for (int i = 0; i < count; ++i) {
      const std::string number = std::to_string(i);
      const auto body = scene.add_body("Link" + number, {{0.1 * i, 0, 0}});
      scene::Joint& joint = scene.add_joint("Joint" + number, scene::JointKind::Revolute,
                                            i == 0 ? std::nullopt : std::optional(body - 1), body);
      joint.frame0.position = {{i == 0 ? 0 : 0.1, 0, 0}};
    }
    return scene;
  };
  Diagnostics findings;
  EXPECT_TRUE(build_model(chain(1023), {}, findings).has_value());
  const Result<Model> longer = build_model(chain(1024), {}, findings);
  ASSERT_FALSE(longer.has_value());
  EXPECT_EQ(longer.error().diagnostic().rule, "mujoco.chain-too-long");
  EXPECT_NE(longer.error().diagnostic().fix.find("PhysX"), std::string::npos);
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

TEST(Errors, ModelsHaveASize) {
  const Path last = *Path::parse("/World/Last");
  EXPECT_TRUE(check_model_size({limits::kModelGeoms, limits::kModelMeshPoints}, last));
  for (const ModelSize& size :
       {ModelSize{limits::kModelGeoms + 1, 0}, ModelSize{0, limits::kModelMeshPoints + 1}}) {
    const Result<void> checked = check_model_size(size, last);
    ASSERT_FALSE(checked);
    EXPECT_EQ(checked.error().code(), ErrorCode::Limit);
    EXPECT_EQ(checked.error().diagnostic().prim, "/World/Last");
  }
  scene::PhysicsScene scene;
  scene.joints.resize(limits::kModelBodies);
  EXPECT_TRUE(check_scene_size(scene));
  scene.joints.resize(limits::kModelBodies + 1);
  EXPECT_EQ(check_scene_size(scene).error().diagnostic().rule, "mujoco.too-large");
}

}  // namespace
}  // namespace tenon::engines::mujoco
